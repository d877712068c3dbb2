/** The explorer's sun, moved by hand, by the clock, or by a measured scan. */

import { sunAt, turned } from "../geometry/day.js";

/** @typedef {import("../host/types.js").Point} Point azimuth and apparent elevation in degrees */

export class Sun {
  /**
   * @param {import("./types.js").Needs<"clamp" | "measured" | "model" | "number" | "parameter"
   *   | "state">} view
   */
  constructor(view) {
    this.view = view;
  }

  /** @returns {Point} */
  direction() {
    return [this.view.number("sun_azimuth"), this.view.number("sun_elevation")];
  }

  /** The kernel's table of the sun's path. @returns {import("../geometry/day.js").DayRow[]} */
  day() {
    return this.view.model.get("_day") ?? [];
  }

  /**
   * Move it by hand, which pauses the clock.
   *
   * @param {number} azimuth degrees
   * @param {number} elevation degrees
   */
  moveTo(azimuth, elevation) {
    const { state } = this.view;
    const clockRuns = state.values.time !== null && this.day().length > 0;
    state.set({ ...this.parameters(azimuth, elevation), ...(clockRuns && { time: null }) });
  }

  /** Set the clock, and the sun with it. @param {number} hours UTC */
  moveTime(hours) {
    const place = sunAt(this.day(), hours);
    this.view.state.set({
      time: round(hours),
      ...(place && this.parameters(place.azimuth, place.apparent)),
    });
  }

  /** Position from time, scan or else the defaults. @returns {Point} */
  automaticDirection() {
    const { view } = this;
    const hours = view.state.values.time;
    const place = hours === null ? null : sunAt(this.day(), Number(hours));
    if (place) return [place.azimuth, view.clamp("sun_elevation", place.apparent)];
    const scan = view.measured.scan();
    if (scan) return [scan.sun_azimuth, scan.sun_elevation];
    const standard = (/** @type {string} */ name) => Number(view.parameter(name).default);
    return [standard("sun_azimuth"), standard("sun_elevation")];
  }

  /** @param {number} azimuth @param {number} elevation */
  parameters(azimuth, elevation) {
    return {
      sun_azimuth: round(turned(azimuth)),
      sun_elevation: round(this.view.clamp("sun_elevation", elevation)),
    };
  }
}

const round = (/** @type {number} */ value) => Math.round(value * 1e4) / 1e4;
