/** Strokes on the picture: drawn while a brush is selected, simplified, and hit-tested. */

import { setAttributes, shape } from "../../ui/element.js";

/**
 * @typedef {import("../../host/types.js").Point} Point
 * @typedef {import("../../host/types.js").Stroke} Stroke
 * @typedef {{ width: number, height: number }} Size
 */

/** Tools that work on strokes. */
export const BRUSHES = ["sky", "not_sky", "erase"];

/** Convert a place to units of the picture's longer side, the unit of radii. @type {(place: Point, size: Size) => Point} */
export const inLongSides = ([x, y], { width, height }) => {
  const long = Math.max(width, height);
  return [(x * width) / long, (y * height) / long];
};

/**
 * Whether a disc touches a stroke's painted area.
 *
 * @param {Stroke} stroke
 * @param {Point} place fractions of width and height
 * @param {number} radius of the disc, in longer sides
 * @param {Size} size
 */
export function touches(stroke, place, radius, size) {
  const at = inLongSides(place, size);
  const points = stroke.points.map((point) => inLongSides(point, size));
  return points.some((point, i) => {
    return distance(at, [points[Math.max(0, i - 1)], point]) <= radius + stroke.radius;
  });
}

/**
 * Drop points closer than a tolerance to the line through their neighbors (Douglas and Peucker
 * 1973): the stroke looks the same, and recipe and history stay small.
 *
 * @param {Point[]} points
 * @param {number} tolerance in longer sides
 * @param {Size} size
 * @returns {Point[]}
 */
export function simplify(points, tolerance, size) {
  if (points.length < 3) return points;
  const ends = [points[0], points[points.length - 1]];
  let [far, most] = [0, 0];
  for (let i = 1; i < points.length - 1; i++) {
    const away = distance(
      inLongSides(points[i], size),
      ends.map((end) => inLongSides(end, size)),
    );
    if (away > most) [far, most] = [i, away];
  }
  if (most <= tolerance) return ends;
  const head = simplify(points.slice(0, far + 1), tolerance, size);
  return [...head.slice(0, -1), ...simplify(points.slice(far), tolerance, size)];
}

/** Distance from a point to a line segment. @param {Point} point @param {Point[]} line */
function distance([x, y], [a, b]) {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const along = ((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy || 1);
  const share = Math.min(1, Math.max(0, along));
  return Math.hypot(a[0] + share * dx - x, a[1] + share * dy - y);
}

/** Make the polyline of a stroke; its parent scales it to the picture. */
export function line(/** @type {string} */ label) {
  return shape("polyline", { class: strokeClass(label) });
}

/** @param {string} label of the stroke */
export const strokeClass = (label) => `sw-stroke sw-stroke-${label}`;

/**
 * @param {SVGElement} node
 * @param {Point[]} points
 * @param {number} radius
 * @param {Size} size
 */
export function setLine(node, points, radius, size) {
  const places = points.length === 1 ? [points[0], points[0]] : points;
  setAttributes(node, {
    points: places.map((point) => inLongSides(point, size).join(",")).join(" "),
    "stroke-width": 2 * radius,
  });
}

export class StrokesLayer {
  /** @param {import("../types.js").Needs<"hand" | "stage" | "state">} needs */
  constructor({ hand, stage, state }) {
    this.hand = hand;
    this.stage = stage;
    this.state = state;
    this.node = shape("g", { class: "sw-strokes" });
    /** @type {unknown} the strokes that the lines show */
    this.shown = null;
    /** @type {SVGElement[]} */
    this.lines = [];
  }

  /** @returns {Stroke[]} */
  strokes() {
    return /** @type {Stroke[]} */ (this.state.values.strokes ?? []);
  }

  /** Fade the strokes that are about to be erased. @param {Set<number>} doomed */
  fade(doomed) {
    this.lines.forEach((node, i) => {
      node.classList.toggle("sw-doomed", doomed.has(i));
    });
  }

  draw() {
    const shown = BRUSHES.includes(this.hand.tool);
    setAttributes(this.node, { visibility: shown ? "visible" : "hidden" });
    if (!shown) return;
    setAttributes(this.node, { transform: this.transform() });
    const strokes = this.strokes();
    if (strokes === this.shown) return;
    this.shown = strokes;
    this.lines = strokes.map(({ label, points, radius }) => {
      const node = line(label);
      setLine(node, points, radius, this.stage.rectangle());
      return node;
    });
    this.node.replaceChildren(...this.lines);
  }

  /** SVG transform from longer sides to the overlay's pixels. */
  transform() {
    const { x, y, width, height } = this.stage.rectangle();
    return `translate(${x} ${y}) scale(${Math.max(width, height)})`;
  }
}
