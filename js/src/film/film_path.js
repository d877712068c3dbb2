/**
 * A film's path: the edit at each moment. Twin of `film_edits` in `sunwidget/film/path.py`, so that
 * the exported film equals the one played.
 */

import { turned } from "../geometry/day.js";

/**
 * @typedef {import("../host/types.js").Edit} Edit
 * @typedef {import("../host/types.js").Parameter} Parameter
 * @typedef {{ seconds: number, recipe: Edit }} KeyFrame
 * @typedef {(share: number) => Edit} FilmPath the edit at a share of the film's length, 0–1
 */

/** CSS's cubic Bézier easing from (0, 0) to (1, 1). @type {(x1: number, y1: number, x2: number, y2: number) => (x: number) => number} */
const bezier = (x1, y1, x2, y2) => {
  /** @type {(a: number, b: number, s: number) => number} */
  const at = (a, b, s) => 3 * (1 - s) ** 2 * s * a + 3 * (1 - s) * s ** 2 * b + s ** 3;
  return (x) => {
    if (x <= 0 || x >= 1) return x;
    let [low, high] = [0, 1];
    for (let i = 0; i < 40; i++) {
      const s = (low + high) / 2;
      if (at(x1, x2, s) < x) low = s;
      else high = s;
    }
    return at(y1, y2, (low + high) / 2);
  };
};

/** @type {Record<string, (x: number) => number>} */
export const EASINGS = {
  linear: (x) => x,
  ease_in_out: bezier(0.42, 0, 0.58, 1),
  ease_in: bezier(0.42, 0, 1, 1),
  ease_out: bezier(0, 0, 0.58, 1),
  smooth: (x) => x, // through key frames without a stop
};

/** Whether a film animates a parameter; all others are constant. @param {Parameter} p */
const isMoved = (p) => p.kind === "number" && !p.analysis;

/**
 * Return the values of a recipe that a film animates.
 *
 * @param {Parameter[]} parameters
 * @param {Edit} recipe
 * @returns {Edit}
 */
export const movedOf = (parameters, recipe) =>
  Object.fromEntries(
    parameters.filter((p) => isMoved(p) && p.name in recipe).map((p) => [p.name, recipe[p.name]]),
  );

/**
 * Complete a key frame's edit: `edit` supplies everything that a film does not animate.
 *
 * @param {Parameter[]} parameters
 * @param {Edit} edit
 * @param {Edit} recipe
 * @returns {Edit}
 */
export function alongEdit(parameters, edit, recipe) {
  const moved = parameters
    .filter(isMoved)
    .map(({ name, default: otherwise }) => [name, recipe[name] ?? otherwise]);
  return { ...edit, ...Object.fromEntries(moved) };
}

/**
 * @param {KeyFrame[]} frames two or more, sorted
 * @param {string} easing
 * @param {Parameter[]} parameters
 * @param {Edit} edit supplies what all frames share
 * @param {Record<string, number>} automatic values from the analysis
 * @returns {FilmPath}
 */
export function keyFramePath(frames, easing, parameters, edit, automatic) {
  const held = frames[0].seconds > 0 ? [{ ...frames[0], seconds: 0 }, ...frames] : frames;
  const length = held[held.length - 1].seconds;
  const knots = held.map(({ seconds }) => seconds / length);
  const edits = held.map(({ recipe }) => alongEdit(parameters, edit, recipe));
  const tracks = parameters
    .filter(({ name }) => edits.some((one) => one[name] !== edits[0][name]))
    .filter(isMoved)
    .map((p) => {
      const values = edits.map((one) => Number(one[p.name] ?? automatic[p.name]));
      const round = p.name === "sun_azimuth";
      if (round) {
        for (let i = 1; i < values.length; i++) {
          values[i] = values[i - 1] + turned(values[i] - values[i - 1]);
        }
      }
      const at = easing === "smooth" ? monotone(knots, values) : straight(knots, values);
      return { p, at: round ? (/** @type {number} */ share) => turned(at(share)) : at };
    });
  return (share) => {
    const j = segment(knots, share);
    const width = knots[j + 1] - knots[j];
    const at = knots[j] + width * EASINGS[easing](Math.min(1, (share - knots[j]) / width));
    const station = knots.findIndex((knot) => Math.abs(knot - at) < 1e-9);
    if (station >= 0) return edits[station];
    /** @type {Edit} */
    const changes = {};
    for (const { p, at: track } of tracks) {
      const [a, b] = [edits[j][p.name], edits[j + 1][p.name]];
      changes[p.name] = a === b ? a : Math.min(p.maximum, Math.max(p.minimum, track(at)));
    }
    return { ...edits[j], ...changes };
  };
}

/** Find the segment between knots that holds a share. @param {number[]} knots @param {number} share */
function segment(knots, share) {
  const after = knots.findIndex((knot) => knot > share);
  return after < 0 ? knots.length - 2 : Math.max(0, after - 1);
}

/** @typedef {(knots: number[], values: number[]) => (share: number) => number} Track */

/** @type {Track} */
const straight = (knots, values) => (share) => {
  const j = segment(knots, share);
  return values[j] + ((values[j + 1] - values[j]) * (share - knots[j])) / (knots[j + 1] - knots[j]);
};

/**
 * A monotone cubic (Fritsch & Butland 1984, as SciPy's PCHIP): values never overshoot their
 * neighbors, so a rising sun never dips.
 *
 * @type {Track}
 */
const monotone = (knots, values) => {
  const count = knots.length;
  if (count < 3) return straight(knots, values);
  const widths = knots.slice(1).map((knot, i) => knot - knots[i]);
  const slopes = widths.map((width, i) => (values[i + 1] - values[i]) / width);
  /** @type {(h0: number, h1: number, m0: number, m1: number) => number} */
  const end = (h0, h1, m0, m1) => {
    const slope = ((2 * h0 + h1) * m0 - h0 * m1) / (h0 + h1);
    if (Math.sign(slope) !== Math.sign(m0)) return 0;
    return Math.sign(m0) !== Math.sign(m1) && Math.abs(slope) > 3 * Math.abs(m0) ? 3 * m0 : slope;
  };
  const tangents = knots.map((_, i) => {
    if (i === 0) return end(widths[0], widths[1], slopes[0], slopes[1]);
    const last = count - 2;
    if (i === count - 1) return end(widths[last], widths[last - 1], slopes[last], slopes[last - 1]);
    const [before, after] = [slopes[i - 1], slopes[i]];
    if (before * after <= 0) return 0;
    const [w1, w2] = [2 * widths[i] + widths[i - 1], widths[i] + 2 * widths[i - 1]];
    return (w1 + w2) / (w1 / before + w2 / after);
  });
  return (share) => {
    const j = segment(knots, share);
    const h = widths[j];
    const t = (share - knots[j]) / h;
    return (
      (1 + 2 * t) * (1 - t) ** 2 * values[j] +
      t * (1 - t) ** 2 * h * tangents[j] +
      t ** 2 * (3 - 2 * t) * values[j + 1] +
      t ** 2 * (t - 1) * h * tangents[j + 1]
    );
  };
};
