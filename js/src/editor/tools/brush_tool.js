/** Strokes that say what is sky or water, and what is not: drawn here, sent as polylines, answered by the kernel's new maps. */

import { setAttributes, shape } from "../../ui/element.js";
import { line, meets, setLine, simplify, strokeClass } from "./strokes.js";

/**
 * @typedef {import("../../host/types.js").Point} Point
 * @typedef {import("../../host/types.js").Stroke} Stroke
 * @typedef {import("../types.js").Needs<"hand" | "stage" | "state" | "strokes">} Needs
 */

const MOST_POINTS = 2000;

/** The ring round the pointer, as large as the brush. */
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
    /** A fast hand is followed point by point. */
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
    /** A key puts it down, and the next press lifts it. */
    this.stays = true;
    /** @type {Point[]} */
    this.points = [];
    this.path = line(tool);
    this.scaled = shape("g", {}, this.path);
    this.node = shape("g", {}, this.scaled, this.ring);
  }

  /** What a stroke of this brush says. @returns {Stroke["label"]} */
  says() {
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
      label: this.says(),
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
    setAttributes(this.path, { class: strokeClass(this.says()) });
    setAttributes(this.ring, { class: `sw-brush sw-stroke-${this.says()}` });
    setAttributes(this.scaled, { transform: this.strokes.transform() });
    setLine(this.path, this.points, this.hand.brushRadius, this.stage.rectangle());
  }
}

/** Takes whole strokes away: those that its ring has met, all of one drag in one step. */
export class EraseTool extends Brush {
  /** @param {Needs} needs */
  constructor(needs) {
    super(needs, "erase");
    /** @type {Set<number>} */
    this.met = new Set();
    this.node = shape("g", {}, this.ring);
  }

  /** @param {Point} place */
  begin(place) {
    this.met.clear();
    this.move(place);
  }

  /** @param {Point} place */
  move(place) {
    this.hover(place);
    for (const i of this.meeting(place)) this.met.add(i);
    this.strokes.doom(this.met);
  }

  /** Before a drag the strokes under the ring are marked. @param {Point | null} place */
  hover(place) {
    super.hover(place);
    if (this.hand.pointer === null) this.strokes.doom(new Set(place && this.meeting(place)));
  }

  /** @param {Point} place */
  meeting(place) {
    const box = this.stage.rectangle();
    const strokes = this.strokes.strokes();
    return strokes.flatMap((stroke, i) =>
      meets(stroke, place, this.hand.brushRadius, box) ? [i] : [],
    );
  }

  end() {
    const { met } = this;
    this.met = new Set();
    if (!met.size) return;
    const strokes = this.strokes.strokes();
    this.state.set({ strokes: strokes.filter((_, i) => !met.has(i)) });
  }

  cancel() {
    this.met.clear();
    this.strokes.doom(this.met);
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
