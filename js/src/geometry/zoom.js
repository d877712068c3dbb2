/**
 * The picture's scale and visible part, as numbers without a page.
 *
 * A scale of 1 (100 %) shows a preview pixel on a screen pixel. Until it is zoomed, the picture fits
 * the available room and follows it. Lengths are CSS pixels of the stage.
 */

/**
 * @typedef {import("../host/types.js").Point} Point
 * @typedef {{ x: number, y: number, width: number, height: number }} Rectangle
 * @typedef {{ width: number, height: number, fit: Rectangle, pixelRatio: number }} Room the stage,
 *   the rectangle that the picture fits, and screen pixels per CSS pixel
 */

// Stops of the keys and buttons, besides the fit.
const STEPS = [0.125, 0.167, 0.25, 0.333, 0.5, 0.667, 1, 1.5, 2, 3, 4, 6, 8, 12, 16];
const MOST = 8; // largest scale: larger pixels show nothing more
const MOST_OF_FIT = 4; // but a small preview may grow to this many times its fit

export class Zoom {
  constructor() {
    /** @type {number | null} screen pixels per preview pixel; null fits the stage */
    this.chosen = null;
    /** @type {Point} the place of the picture in the middle of the stage */
    this.center = [0.5, 0.5];
    /** @type {Point} size of the preview in pixels */
    this.size = [1, 1];
    /** @type {Room} */
    this.room = { width: 1, height: 1, fit: { x: 0, y: 0, width: 1, height: 1 }, pixelRatio: 1 };
    /** @type {() => void} called after a zoom or pan */
    this.onChange = () => {};
  }

  get fits() {
    return this.chosen === null;
  }

  /** The scale at which the whole picture just fits. */
  get fitScale() {
    return (this.room.fit.width * this.room.pixelRatio) / this.size[0];
  }

  get scale() {
    return this.chosen ?? this.fitScale;
  }

  /** The smallest and the largest scale. @returns {Point} */
  get bounds() {
    return [Math.min(1, this.fitScale), Math.max(MOST, MOST_OF_FIT * this.fitScale)];
  }

  /** @param {Room} room */
  setRoom(room) {
    this.room = room;
    if (this.scale < this.bounds[0]) this.chosen = null;
  }

  /** The picture's rectangle on the stage. @returns {Rectangle} */
  box() {
    const { fit, width, height, pixelRatio } = this.room;
    if (this.chosen === null) return fit;
    const whole = (/** @type {number} */ length) => Math.max(1, Math.round(length)) / pixelRatio;
    const [w, h] = this.size.map((length) => whole(length * this.scale));
    const margin = Math.max(0, Math.min(fit.x, fit.y));
    return {
      x: start(w, width, margin, width / 2 - this.center[0] * w),
      y: start(h, height, margin, height / 2 - this.center[1] * h),
      width: w,
      height: h,
    };
  }

  fit() {
    this.chosen = null;
    this.onChange();
  }

  /**
   * Set the scale; the place of the picture at `anchor` stays there, as far as the picture's edges
   * allow.
   *
   * @param {number} scale
   * @param {Point} [anchor] on the stage; default its middle
   */
  zoomTo(scale, anchor = this.middle()) {
    this.hold(this.placeAt(anchor), anchor, scale);
  }

  /**
   * Set the scale and move a place of the picture to a point of the stage, as far as the picture's
   * edges allow.
   *
   * @param {Point} place
   * @param {Point} at
   * @param {number} scale
   */
  hold(place, at, scale) {
    const [least, most] = this.bounds;
    const wanted = Math.min(most, Math.max(least, scale));
    if (wanted === this.fitScale) return this.fit();
    this.chosen = wanted;
    const { width, height } = this.box();
    const [mx, my] = this.middle();
    this.center = [place[0] + (mx - at[0]) / width, place[1] + (my - at[1]) / height];
    // Drop what lies past the picture's edge, so that panning back responds at once.
    this.center = this.placeAt(this.middle());
    this.onChange();
  }

  /** Go to the next larger (1) or smaller (-1) stop; the fit is one. @param {1 | -1} direction @param {Point} [anchor] */
  step(direction, anchor) {
    const [least, most] = this.bounds;
    const steps = [...STEPS, this.fitScale].sort((a, b) => a - b);
    if (direction < 0) steps.reverse();
    const past = (/** @type {number} */ step) => direction * (step / this.scale - 1) > 1e-3;
    const next = steps.find((step) => past(step) && step >= least && step <= most);
    if (next !== undefined) this.zoomTo(next, anchor);
  }

  /** Toggle between the fit and 100 %, or 200 % if these are the same. @param {Point} [anchor] */
  toggle(anchor) {
    if (!this.fits) return this.fit();
    this.zoomTo(Math.abs(this.fitScale - 1) < 0.02 ? 2 : 1, anchor);
  }

  /** Pan the picture. @param {number} x @param {number} y */
  pan(x, y) {
    const [left, top] = this.middle();
    this.bring(this.placeAt([left, top]), [left + x, top + y]);
  }

  /** Pan until a place of the picture is at a point of the stage, as far as its edges allow. @param {Point} place @param {Point} [at] */
  bring(place, at = this.middle()) {
    if (!this.fits) this.hold(place, at, this.scale);
  }

  /** Return the place of the picture at a point of the stage. @param {Point} point @returns {Point} */
  placeAt([x, y]) {
    const box = this.box();
    return [(x - box.x) / box.width, (y - box.y) / box.height];
  }

  /** @returns {Point} */
  middle() {
    return [this.room.width / 2, this.room.height / 2];
  }
}

/**
 * Return the picture's start along one side of the stage: centered if it fits, else at most the
 * margin from the edge.
 *
 * @param {number} length of the picture
 * @param {number} room of the stage
 * @param {number} margin
 * @param {number} wanted
 */
function start(length, room, margin, wanted) {
  if (length <= room - 2 * margin) return (room - length) / 2;
  return Math.min(margin, Math.max(room - margin - length, wanted));
}
