/**
 * Drawing speed on this machine: a line of the help, and a live row below the picture if the page's
 * address has `?timings`.
 */

import { cardName, Stopwatch } from "../../gl/stopwatch.js";
import { element } from "../../ui/element.js";

/** @typedef {import("../../gl/stopwatch.js").Lap} Lap */

const KEPT = 15; // frames for the median: a drag of a second or less

/** Timings of the last frames drawn at one size. */
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

  /** Format the median; "" before the first frame was measured. */
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

/** @type {import("../types.js").MakePart<"drawing" | "statusBar">} */
export function timings({ drawing, statusBar }) {
  const live = wantsTimings(window.location.href);
  const timed = new Timings();
  const row = element("div", { class: "sw-timings" });
  if (live) statusBar.node.append(row);
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
