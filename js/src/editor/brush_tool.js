/** Sky / not-sky strokes: drawn here, sent as polylines, answered by the kernel's new maps. */

import { setAttributes, shape } from "../controls/element.js";

/**
 * @typedef {import("../types.js").Point} Point
 * @typedef {import("../types.js").Stroke} Stroke
 * @typedef {import("./view.js").View} View
 */

const MOST_POINTS = 2000;

export class BrushTool {
  /**
   * @param {View} view
   * @param {"sky" | "not_sky"} label
   */
  constructor(view, label) {
    this.view = view;
    this.label = label;
    /** @type {Point[]} */
    this.points = [];
    this.path = shape("polyline", { class: `sw-stroke sw-stroke-${label}` });
    this.cursor = shape("circle", { class: `sw-brush sw-stroke-${label}` });
    this.node = shape("g", {}, this.path, this.cursor);
  }

  /** Radius in CSS pixels. */
  radius() {
    const { width, height } = this.view.stage.rectangle();
    return this.view.brushRadius * Math.max(width, height);
  }

  /** @param {Point} place */
  begin(place) {
    this.points = [round(place)];
    this.hover(place);
    this.draw();
  }

  /** @param {Point} place */
  move(place) {
    this.hover(place);
    const box = this.view.stage.rectangle();
    const [x, y] = this.points[this.points.length - 1];
    const way = Math.hypot((place[0] - x) * box.width, (place[1] - y) * box.height);
    // Points closer than a quarter of the brush add nothing to its mark.
    if (way < Math.max(1, this.radius() / 4) || this.points.length >= MOST_POINTS) return;
    this.points.push(round(place));
    this.draw();
  }

  end() {
    if (!this.points.length) return;
    /** @type {Stroke} */
    const stroke = {
      label: this.label,
      points: this.points,
      radius: Math.round(this.view.brushRadius * 1e5) / 1e5,
    };
    this.points = [];
    const strokes = /** @type {Stroke[]} */ (this.view.state.values.strokes ?? []);
    this.view.state.set({ strokes: [...strokes, stroke] });
    this.draw();
  }

  cancel() {
    this.points = [];
    this.draw();
  }

  /** @param {Point} place */
  hover(place) {
    const [cx, cy] = this.view.stage.onOverlay(place);
    setAttributes(this.cursor, { cx, cy, r: this.radius() });
  }

  draw() {
    const active = this.view.tool === this.label;
    setAttributes(this.node, { visibility: active ? "visible" : "hidden" });
    if (!active) return;
    const places = this.points.length === 1 ? [this.points[0], this.points[0]] : this.points;
    setAttributes(this.path, {
      points: places.map((place) => this.view.stage.onOverlay(place).join(",")).join(" "),
      "stroke-width": 2 * this.radius(),
    });
  }
}

/** @type {(place: Point) => Point} */
const round = ([x, y]) => [
  Math.round(Math.min(1, Math.max(0, x)) * 1e4) / 1e4,
  Math.round(Math.min(1, Math.max(0, y)) * 1e4) / 1e4,
];
