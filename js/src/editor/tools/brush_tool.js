/** Strokes that mark sky or water, or their absence: sent as polylines, answered with new maps by the kernel. */

import { setAttributes, shape } from "../../ui/element.js";
import { line, setLine, simplify, strokeClass, touches } from "./strokes.js";

/**
 * @typedef {import("../../host/types.js").Point} Point
 * @typedef {import("../../host/types.js").Stroke} Stroke
 * @typedef {import("../types.js").Needs<"hand" | "stage" | "state" | "strokes">} Needs
 */

const MOST_POINTS = 2000;

/** The ring around the pointer, as large as the brush. */
class Brush {
  /**
   * @param {Needs} needs
   * @param {string} label the tool's name
   */
  constructor({ hand, stage, state, strokes }, label) {
    this.hand = hand;
    this.stage = stage;
    this.state = state;
    this.strokes = strokes;
    this.label = label;
    /** The tool receives every point of a fast drag. */
    this.fine = true;
    /** @type {Point | null} */
    this.at = null;
    this.ring = shape("circle", { class: `sw-brush sw-stroke-${label}` });
  }

  /** Radius in CSS pixels. */
  radius() {
    const { width, height } = this.stage.rectangle();
    return this.hand.brushRadius * Math.max(width, height);
  }

  /** @param {Point | null} place null when the pointer has left */
  hover(place) {
    this.at = place;
    this.drawRing();
  }

  drawRing() {
    const shown = this.hand.tool === this.label && this.at;
    setAttributes(this.ring, { visibility: shown ? "visible" : "hidden" });
    if (!this.at || !shown) return;
    const [cx, cy] = this.stage.onOverlay(this.at);
    setAttributes(this.ring, { cx, cy, r: this.radius() });
  }
}

export class BrushTool extends Brush {
  /**
   * @param {Needs} needs
   * @param {"sky" | "not_sky"} tool
   */
  constructor(needs, tool) {
    super(needs, tool);
    /** One key press puts the brush down, the next lifts it. */
    this.stays = true;
    /** @type {Point[]} */
    this.points = [];
    this.path = line(tool);
    this.scaled = shape("g", {}, this.path);
    this.node = shape("g", {}, this.scaled, this.ring);
  }

  /** The label of a stroke of this brush. @returns {Stroke["label"]} */
  strokeLabel() {
    if (this.hand.subject === "sky") return this.label === "sky" ? "sky" : "not_sky";
    return this.label === "sky" ? "water" : "not_water";
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
    const box = this.stage.rectangle();
    const [x, y] = this.points[this.points.length - 1];
    const moved = Math.hypot((place[0] - x) * box.width, (place[1] - y) * box.height);
    // Points closer than a quarter of the brush add nothing to its mark.
    if (moved < Math.max(1, this.radius() / 4) || this.points.length >= MOST_POINTS) return;
    this.points.push(round(place));
    this.draw();
  }

  end() {
    if (!this.points.length) return;
    /** @type {Stroke} */
    const stroke = {
      label: this.strokeLabel(),
      points: simplify(this.points, this.hand.brushRadius / 10, this.stage.rectangle()),
      radius: Math.round(this.hand.brushRadius * 1e5) / 1e5,
    };
    this.points = [];
    this.state.set({ strokes: [...this.strokes.strokes(), stroke] });
    this.draw();
  }

  cancel() {
    this.points = [];
    this.draw();
  }

  draw() {
    const active = this.hand.tool === this.label;
    setAttributes(this.node, { visibility: active ? "visible" : "hidden" });
    this.drawRing();
    if (!active) return;
    setAttributes(this.path, { class: strokeClass(this.strokeLabel()) });
    setAttributes(this.ring, { class: `sw-brush sw-stroke-${this.strokeLabel()}` });
    setAttributes(this.scaled, { transform: this.strokes.transform() });
    setLine(this.path, this.points, this.hand.brushRadius, this.stage.rectangle());
  }
}

/** Erases whole strokes that its ring touches; one drag is one history step. */
export class EraseTool extends Brush {
  /** @param {Needs} needs */
  constructor(needs) {
    super(needs, "erase");
    /** @type {Set<number>} */
    this.touched = new Set();
    this.node = shape("g", {}, this.ring);
  }

  /** @param {Point} place */
  begin(place) {
    this.touched.clear();
    this.move(place);
  }

  /** @param {Point} place */
  move(place) {
    this.hover(place);
    for (const i of this.findTouched(place)) this.touched.add(i);
    this.strokes.fade(this.touched);
  }

  /** Before a drag, fade the strokes under the ring. @param {Point | null} place */
  hover(place) {
    super.hover(place);
    if (this.hand.pointer === null) this.strokes.fade(new Set(place && this.findTouched(place)));
  }

  /** @param {Point} place */
  findTouched(place) {
    const box = this.stage.rectangle();
    const strokes = this.strokes.strokes();
    return strokes.flatMap((stroke, i) =>
      touches(stroke, place, this.hand.brushRadius, box) ? [i] : [],
    );
  }

  end() {
    const { touched } = this;
    this.touched = new Set();
    if (!touched.size) return;
    const strokes = this.strokes.strokes();
    this.state.set({ strokes: strokes.filter((_, i) => !touched.has(i)) });
  }

  cancel() {
    this.touched.clear();
    this.strokes.fade(this.touched);
  }

  draw() {
    this.drawRing();
  }
}

/** @type {(place: Point) => Point} */
const round = ([x, y]) => [
  Math.round(Math.min(1, Math.max(0, x)) * 1e4) / 1e4,
  Math.round(Math.min(1, Math.max(0, y)) * 1e4) / 1e4,
];
