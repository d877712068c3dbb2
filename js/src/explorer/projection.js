/**
 * Three projections between pixels and directions: the browser's twin of
 * `sunwidget/shaders/explorer/projection.glsl` and `sunwidget/explorer/projection.py`.
 *
 * dome: equidistant fisheye, zenith in the middle, `view_azimuth` at the top; seen from below, so
 * east lies to the left of north. panorama: equirectangular, −10 to 90 degrees. camera:
 * perspective. Azimuths and elevations are degrees, azimuths clockwise; pixels have their origin
 * at the top left.
 */

import { turned } from "../geometry/day.js";

/** Diameter of the dome over the smaller side; the rest is room for labels. */
export const DOME_SHARE = 0.94;
const PANORAMA_BOTTOM = -10;
const PANORAMA_HEIGHT = 100;
/** Directions continue this far below the horizon, where the sun can be dragged. */
const LOWEST = -12;

/** Width over height of each projection's picture. @type {Record<string, number>} */
export const ASPECTS = { dome: 1, panorama: 360 / PANORAMA_HEIGHT, camera: 1.5 };

const RADIANS = Math.PI / 180;

/** @typedef {{ view_azimuth: number, view_elevation: number, fov: number }} Look */

export class Projection {
  /**
   * @param {string} name dome, panorama or camera
   * @param {[number, number]} size of the picture, in any unit that pixels are given in
   * @param {Look} look
   */
  constructor(name, size, look) {
    this.name = name;
    this.size = size;
    this.look = look;
    const [width, height] = size;
    if (name === "dome") this.scale = (DOME_SHARE * Math.min(width, height)) / 2;
    else if (name === "panorama") this.scale = Math.min(width / 360, height / PANORAMA_HEIGHT);
    else this.scale = height / 2 / Math.tan((look.fov * RADIANS) / 2);
  }

  /**
   * Return a pixel's direction. Beyond the dome's rim and below the panorama it continues to −12 degrees.
   *
   * @param {number} x
   * @param {number} y
   * @returns {[number, number] | null} azimuth and elevation; null where no sky is shown
   */
  direction(x, y) {
    const right = x - this.size[0] / 2;
    const up = this.size[1] / 2 - y;
    const { view_azimuth, view_elevation } = this.look;
    if (this.name === "dome") {
      const elevation = 90 * (1 - Math.hypot(right, up) / this.scale);
      if (elevation < LOWEST) return null;
      return [turned(view_azimuth + Math.atan2(-right, up) / RADIANS), elevation];
    }
    if (this.name === "panorama") {
      const turn = right / this.scale;
      const elevation = PANORAMA_BOTTOM + PANORAMA_HEIGHT / 2 + up / this.scale;
      if (Math.abs(turn) > 180 || elevation < LOWEST || elevation > 90) return null;
      return [turned(view_azimuth + turn), elevation];
    }
    const rise = view_elevation * RADIANS;
    const ahead = this.scale * Math.cos(rise) - up * Math.sin(rise);
    const above = this.scale * Math.sin(rise) + up * Math.cos(rise);
    return [
      turned(view_azimuth + Math.atan2(right, ahead) / RADIANS),
      Math.atan2(above, Math.hypot(right, ahead)) / RADIANS,
    ];
  }

  /** As `direction`, or else the nearest direction toward the picture's middle. @param {number} x @param {number} y */
  nearest(x, y) {
    const [cx, cy] = this.size.map((side) => side / 2);
    const along = (/** @type {number} */ share) =>
      this.direction(cx + share * (x - cx), cy + share * (y - cy));
    let found = along(1);
    let [inside, outside] = [0, 1];
    for (let i = 0; i < 12 && !(found && inside === 0); i++) {
      const middle = (inside + outside) / 2;
      const here = along(middle);
      if (here) [found, inside] = [here, middle];
      else outside = middle;
    }
    return found;
  }

  /**
   * Return a direction's pixel, which may lie outside the picture.
   *
   * @param {number} azimuth
   * @param {number} elevation
   * @returns {[number, number] | null} null behind the camera
   */
  pixel(azimuth, elevation) {
    const turn = turned(azimuth - this.look.view_azimuth);
    const side = turn * RADIANS;
    if (this.name === "dome") {
      const radius = this.scale * (1 - elevation / 90);
      return this.place(-radius * Math.sin(side), radius * Math.cos(side));
    }
    if (this.name === "panorama") {
      const middle = PANORAMA_BOTTOM + PANORAMA_HEIGHT / 2;
      return this.place(turn * this.scale, (elevation - middle) * this.scale);
    }
    const rise = this.look.view_elevation * RADIANS;
    const high = elevation * RADIANS;
    const level = Math.cos(high) * Math.cos(side);
    const ahead = level * Math.cos(rise) + Math.sin(high) * Math.sin(rise);
    if (ahead <= 1e-6) return null;
    const focal = this.scale / ahead;
    return this.place(
      focal * Math.cos(high) * Math.sin(side),
      focal * (Math.sin(high) * Math.cos(rise) - level * Math.sin(rise)),
    );
  }

  /**
   * @param {number} right
   * @param {number} up
   * @returns {[number, number]}
   */
  place(right, up) {
    return [this.size[0] / 2 + right, this.size[1] / 2 - up];
  }
}
