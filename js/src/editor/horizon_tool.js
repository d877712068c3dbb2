/** The horizon's line with a handle at either end: the kernel answers with a new camera. */

import { setAttributes, shape } from "../controls/element.js";

/**
 * @typedef {import("../types.js").Point} Point
 * @typedef {import("./view.js").View} View
 */

const ENDS = [0.12, 0.88]; // fractions of the width at which the handles stand

export class HorizonTool {
  /** @param {View} view */
  constructor(view) {
    this.view = view;
    /** @type {[Point, Point] | null} the line while it is dragged */
    this.line = null;
    /** @type {0 | 1 | "both"} */
    this.grip = "both";
    /** @type {Point} */
    this.last = [0, 0];
    this.path = shape("line", { class: "sw-horizon-line" });
    this.handles = ["Horizon, left end", "Horizon, right end"].map((label, i) => {
      const handle = shape("circle", {
        class: "sw-horizon-handle",
        r: 8,
        tabindex: 0,
        role: "slider",
        "aria-label": label,
      });
      handle.addEventListener("keydown", (event) => this.onKey(event, /** @type {0 | 1} */ (i)));
      for (const end of ["keyup", "blur"]) handle.addEventListener(end, () => this.end());
      return handle;
    });
    this.node = shape("g", { class: "sw-horizon-tool" }, this.path, ...this.handles);
  }

  /** The line now: dragged, given by the person, or found. @returns {[Point, Point] | null} */
  current() {
    const { camera } = this.view;
    if (this.line || !camera) return this.line;
    const hint = /** @type {[Point, Point] | null} */ (this.view.state.values.horizon_hint);
    if (hint) return through(hint);
    const [ux, uy, uz] = camera.up;
    return /** @type {[Point, Point]} */ (
      ENDS.map((x) => {
        const u = (x - 0.5) * camera.width;
        const row = camera.height / 2 - (ux * u + uz * camera.focal) / uy;
        return [x, row / camera.height];
      })
    );
  }

  /** @param {Point} place */
  begin(place) {
    this.line = this.current();
    if (!this.line) return;
    const box = this.view.stage.rectangle();
    const reach = this.line.map(([x, y]) =>
      Math.hypot((x - place[0]) * box.width, (y - place[1]) * box.height),
    );
    this.grip = reach[0] < 40 ? 0 : reach[1] < 40 ? 1 : "both";
    this.last = place;
  }

  /** @param {Point} place */
  move(place) {
    if (!this.line) return;
    const rise = place[1] - this.last[1];
    this.last = place;
    this.shift(rise);
  }

  /** @param {number} rise fractions of the height */
  shift(rise) {
    if (!this.line) return;
    const [left, right] = this.line;
    if (this.grip !== 1) left[1] = limit(left[1] + rise);
    if (this.grip !== 0) right[1] = limit(right[1] + rise);
    this.view.drawOverlay();
  }

  end() {
    if (!this.line) return;
    const line = this.line.map(([x, y]) => [round(x), round(y)]);
    this.line = null;
    this.view.state.set({ horizon_hint: line });
  }

  cancel() {
    this.line = null;
    this.view.drawOverlay();
  }

  /**
   * @param {KeyboardEvent} event
   * @param {0 | 1} grip
   */
  onKey(event, grip) {
    const step = { ArrowUp: -0.002, ArrowDown: 0.002 }[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    this.line ??= this.current();
    this.grip = grip;
    this.shift(step * (event.shiftKey ? 10 : 1));
  }

  draw() {
    const line = this.current();
    const shown = this.view.tool === "horizon" && line;
    setAttributes(this.node, { visibility: shown ? "visible" : "hidden" });
    for (const handle of this.handles) setAttributes(handle, { tabindex: shown ? 0 : -1 });
    if (!shown) return;
    const [a, b] = line.map((place) => this.view.stage.onOverlay(place));
    const box = this.view.stage.rectangle();
    const slope = (b[1] - a[1]) / (b[0] - a[0]);
    setAttributes(this.path, {
      x1: box.x,
      y1: a[1] + slope * (box.x - a[0]),
      x2: box.x + box.width,
      y2: a[1] + slope * (box.x + box.width - a[0]),
    });
    [a, b].forEach(([x, y], i) => {
      setAttributes(this.handles[i], {
        cx: x,
        cy: y,
        "aria-valuenow": line[i][1].toFixed(3),
        "aria-valuetext": `${(100 * line[i][1]).toFixed(1)} % from the top`,
      });
    });
  }
}

/** @param {[Point, Point]} hint @returns {[Point, Point]} the same line at the handles' columns */
function through([a, b]) {
  const slope = (b[1] - a[1]) / (b[0] - a[0]);
  return /** @type {[Point, Point]} */ (ENDS.map((x) => [x, a[1] + slope * (x - a[0])]));
}

const limit = (/** @type {number} */ y) => Math.min(3, Math.max(-2, y));
const round = (/** @type {number} */ value) => Math.round(value * 1e5) / 1e5;
