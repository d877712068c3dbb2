/**
 * Pixel ↔ direction. The kernel's twin is `sunwidget/geometry/camera.py`.
 *
 * Pixels have their origin at the top left corner of the picture; camera axes are x right,
 * y down, z forward. Angles are degrees; azimuth is relative to the camera's heading,
 * positive to the right.
 */

const DEGREE = Math.PI / 180;

/** @typedef {[number, number, number]} Vector */

/** @type {(a: Vector, b: Vector) => number} */
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** @type {(a: Vector, b: Vector) => Vector} */
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** @type {(a: Vector) => Vector} */
const normalize = (a) => {
  const length = Math.hypot(...a);
  return [a[0] / length, a[1] / length, a[2] / length];
};

export class Camera {
  /**
   * @param {number} width pixels
   * @param {number} height pixels
   * @param {number} fovVertical degrees
   * @param {number} pitch degrees, positive when the camera looks up
   * @param {number} roll degrees, positive when the horizon falls to the right
   */
  constructor(width, height, fovVertical, pitch, roll) {
    this.width = width;
    this.height = height;
    this.focal = height / 2 / Math.tan((fovVertical * DEGREE) / 2);
    const [p, r] = [pitch * DEGREE, roll * DEGREE];
    /** @type {Vector} */
    this.up = [Math.sin(r) * Math.cos(p), -Math.cos(r) * Math.cos(p), Math.sin(p)];
    const [x, y, z] = this.up;
    /** @type {Vector} */
    this.forward = normalize([-z * x, -z * y, 1 - z * z]);
    /** @type {Vector} */
    this.right = cross(this.forward, this.up);
  }

  /**
   * Return azimuth and elevation of a pixel, which may lie outside the frame.
   *
   * @param {number} x
   * @param {number} y
   * @returns {[number, number]}
   */
  angles(x, y) {
    const ray = normalize([
      (x - this.width / 2) / this.focal,
      (y - this.height / 2) / this.focal,
      1,
    ]);
    const elevation = Math.asin(Math.max(-1, Math.min(1, dot(ray, this.up))));
    const azimuth = Math.atan2(dot(ray, this.right), dot(ray, this.forward));
    return [azimuth / DEGREE, elevation / DEGREE];
  }

  /**
   * Return the pixel of a direction, or null behind the camera.
   *
   * @param {number} azimuth
   * @param {number} elevation
   * @returns {[number, number] | null}
   */
  pixel(azimuth, elevation) {
    const ray = this.ray(azimuth, elevation);
    if (ray[2] <= 1e-6) return null;
    return [
      this.width / 2 + (this.focal * ray[0]) / ray[2],
      this.height / 2 + (this.focal * ray[1]) / ray[2],
    ];
  }

  /**
   * Return a direction's bearing in the picture plane, a unit vector from the center. Also defined
   * behind the camera, so that an arrow at the edge can point there.
   *
   * @param {number} azimuth
   * @param {number} elevation
   * @returns {[number, number]}
   */
  bearing(azimuth, elevation) {
    const [x, y] = this.ray(azimuth, elevation);
    const length = Math.hypot(x, y) || 1;
    return [x / length, y / length];
  }

  /**
   * @param {number} azimuth
   * @param {number} elevation
   * @returns {Vector} unit vector in camera axes
   */
  ray(azimuth, elevation) {
    const [a, e] = [azimuth * DEGREE, elevation * DEGREE];
    const [east, up, ahead] = [Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e)];
    return /** @type {Vector} */ (
      [0, 1, 2].map((i) => east * this.right[i] + up * this.up[i] + ahead * this.forward[i])
    );
  }
}
