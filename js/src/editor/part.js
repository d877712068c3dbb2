/**
 * What hangs on the editor, and how it hears of what happens. A part is told:
 *
 *   loaded(scene)  the analysis, or an answer to a correction, has arrived
 *   forget()       nothing of the last photo is true of the next
 *   show()         the edit or the history changed: controls follow at once
 *   draw()         the overlay is drawn: layout, zoom or edit changed
 *   drawn(scale)   a frame stands on the canvas, at a share of its full size
 *   point(place)   the pointer, or the keyboard's cross, is at a place of the picture, or gone
 */

/**
 * @typedef {import("../host/types.js").Point} Point
 * @typedef {import("../host/types.js").Scene} Scene
 * @typedef {{
 *   loaded?: (scene: Scene) => void,
 *   forget?: () => void,
 *   show?: () => void,
 *   draw?: () => void,
 *   drawn?: (scale: number) => void,
 *   point?: (place: Point | null) => void,
 * }} Part
 */

/** All parts of an editor, told one after the other. */
export class Parts {
  constructor() {
    /** @type {Part[]} */
    this.all = [];
  }

  /** @param {Part[]} parts */
  add(...parts) {
    this.all.push(...parts);
  }

  /** @param {Scene} scene */
  loaded(scene) {
    for (const part of this.all) part.loaded?.(scene);
    this.show();
  }

  forget() {
    for (const part of this.all) part.forget?.();
    this.show();
  }

  show() {
    for (const part of this.all) part.show?.();
  }

  draw() {
    for (const part of this.all) part.draw?.();
  }

  /** @param {number} scale */
  drawn(scale) {
    for (const part of this.all) part.drawn?.(scale);
  }

  /** @param {Point | null} place */
  point(place) {
    for (const part of this.all) part.point?.(place);
  }
}
