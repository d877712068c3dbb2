/** Marks the photo's sun with a click; the kernel answers with a new fit. */

import { shape } from "../../ui/element.js";

/** @typedef {import("../../host/types.js").Point} Point */

export class PickTool {
  /** @param {import("../types.js").Needs<"hand" | "state">} needs */
  constructor({ hand, state }) {
    this.hand = hand;
    this.state = state;
    this.node = shape("g");
    /** @type {Point | null} */
    this.at = null;
  }

  /** @param {Point} place */
  begin(place) {
    this.at = place;
  }

  /** @param {Point} place */
  move(place) {
    this.at = place;
  }

  end() {
    if (!this.at) return;
    const hint = this.at.map((value) => Math.round(value * 1e5) / 1e5);
    this.at = null;
    // The sun restarts from the new mark, not from where it was moved before.
    this.state.set({ sun_hint: hint, sun_azimuth: null, sun_elevation: null });
    this.hand.setTool("sun");
  }

  cancel() {
    this.at = null;
  }

  draw() {}
}
