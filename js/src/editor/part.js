/**
 * Parts of the editor and the events they receive:
 *
 *   loaded(scene)  the analysis, or its update after a correction, has arrived
 *   forget()       another photo is loading: drop everything about the last one
 *   show()         the edit or the history changed: update controls at once
 *   draw()         layout, zoom or edit changed: draw the overlay
 *   drawn(scale)   the canvas shows a new frame, at a share of its full size
 *   point(place)   the pointer or the keyboard's cross moved on the picture; null when it left
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

/** Passes each event to all parts of an editor in turn. */
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
