/**
 * How fast the picture is drawn here: a live row below the picture where the page's address has `?timings`, and
 * a line of the help. So whoever opens it on a machine of their own can tell.
 */

import { cardName, Stopwatch } from "../../gl/stopwatch.js";
import { element } from "../../ui/element.js";

/** @typedef {import("../../gl/stopwatch.js").Lap} Lap */

const KEPT = 15; // frames whose median is shown: a drag of a second or less

/** Of the last frames drawn at one size. */
export class Timings {
  constructor() {
    /** @type {Lap[]} */
    this.laps = [];
    this.size = "";
  }

  /** @param {Lap} lap @param {string} size width × height of the frame */
  add(lap, size) {
    if (size !== this.size || this.laps[0]?.by !== lap.by) this.laps = [];
    this.size = size;
    this.laps = [...this.laps, lap].slice(-KEPT);
  }

  /** As a person reads it; "" before the first frame was measured. */
  text() {
    const { laps, size } = this;
    if (laps.length === 0) return "";
    const sorted = laps.map(({ ms }) => ms).sort((a, b) => a - b);
    const median = sorted[Math.floor((sorted.length - 1) / 2)];
    const ms = median < 10 ? median.toFixed(1) : median.toFixed(0);
    return `${size} in ${ms} ms (${laps[0].by}, median of ${laps.length})`;
  }
}

/** @param {string} address of a page */
export const wantsTimings = (address) => new URL(address).searchParams.has("timings");

/** @type {import("../types.js").MakePart<"drawing" | "foot">} */
export function timings({ drawing, foot }) {
  const live = wantsTimings(window.location.href);
  const timed = new Timings();
  const row = element("div", { class: "sw-timings" });
  if (live) foot.node.append(row);
  let card = "";
  const { frame } = drawing;
  frame.stopwatch = new Stopwatch((lap) => {
    if (frame.graph) card ||= cardName(frame.graph.gl);
    timed.add(lap, `${frame.canvas.width} × ${frame.canvas.height}`);
    drawing.speed = `${timed.text()} · ${card}`;
    if (live) row.textContent = drawing.speed;
  });
  return {};
}
