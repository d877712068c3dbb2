/**
 * The perceived difference of two colors: CIEDE2000 (CIE 142-2001; Sharma, Wu and Dalal 2005), of sRGB
 * pictures under D65.
 */

import { LIGHT } from "../gl/srgb.js";

const DEGREE = Math.PI / 180;
const FAR = 25 ** 7;
// Columns of sRGB to XYZ over D65's own XYZ (IEC 61966-2-1).
const X = [0.4124564 / 0.95047, 0.3575761 / 0.95047, 0.1804375 / 0.95047];
const Y = [0.2126729, 0.7151522, 0.072175];
const Z = [0.0193339 / 1.08883, 0.119192 / 1.08883, 0.9503041 / 1.08883];

/** @typedef {[number, number, number]} Lab CIE L*, a*, b* */

/** @param {number} t */
const compress = (t) => (t > 216 / 24389 ? Math.cbrt(t) : ((24389 / 27) * t + 16) / 116);

/**
 * @param {number} r level of sRGB, 0–255
 * @param {number} g
 * @param {number} b
 * @returns {Lab}
 */
export function lab(r, g, b) {
  const mix = (/** @type {number[]} */ row) =>
    compress(row[0] * LIGHT[r] + row[1] * LIGHT[g] + row[2] * LIGHT[b]);
  const [x, y, z] = [mix(X), mix(Y), mix(Z)];
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

/**
 * @param {Lab} one
 * @param {Lab} other
 */
export function ciede2000([l1, a1, b1], [l2, a2, b2]) {
  const chroma = (Math.hypot(a1, b1) + Math.hypot(a2, b2)) / 2;
  const g = 0.5 * (1 - Math.sqrt(chroma ** 7 / (chroma ** 7 + FAR)));
  const [c1, c2] = [Math.hypot(a1 * (1 + g), b1), Math.hypot(a2 * (1 + g), b2)];
  const h1 = hue(a1 * (1 + g), b1);
  const h2 = hue(a2 * (1 + g), b2);
  const gray = c1 * c2 === 0;
  let turn = gray ? 0 : h2 - h1;
  if (turn > 180) turn -= 360;
  if (turn < -180) turn += 360;
  const dL = l2 - l1;
  const dC = c2 - c1;
  const dH = 2 * Math.sqrt(c1 * c2) * Math.sin((turn / 2) * DEGREE);
  const l = (l1 + l2) / 2;
  const c = (c1 + c2) / 2;
  let h = gray ? h1 + h2 : (h1 + h2) / 2;
  if (!gray && Math.abs(h1 - h2) > 180) h += h < 180 ? 180 : -180;
  const t =
    1 -
    0.17 * Math.cos((h - 30) * DEGREE) +
    0.24 * Math.cos(2 * h * DEGREE) +
    0.32 * Math.cos((3 * h + 6) * DEGREE) -
    0.2 * Math.cos((4 * h - 63) * DEGREE);
  const sL = 1 + (0.015 * (l - 50) ** 2) / Math.sqrt(20 + (l - 50) ** 2);
  const sC = 1 + 0.045 * c;
  const sH = 1 + 0.015 * c * t;
  const rotation = 60 * Math.exp(-(((h - 275) / 25) ** 2));
  const rT = -2 * Math.sqrt(c ** 7 / (c ** 7 + FAR)) * Math.sin(rotation * DEGREE);
  return Math.sqrt((dL / sL) ** 2 + (dC / sC) ** 2 + (dH / sH) ** 2 + rT * (dC / sC) * (dH / sH));
}

/** Degrees in [0, 360). @param {number} a @param {number} b */
function hue(a, b) {
  if (a === 0 && b === 0) return 0;
  const angle = Math.atan2(b, a) / DEGREE;
  return angle < 0 ? angle + 360 : angle;
}

/**
 * Mean and 95th percentile over the pixels of two pictures of one size.
 *
 * @param {Uint8ClampedArray} one RGBA
 * @param {Uint8ClampedArray} other
 */
export function pictureDifference(one, other) {
  const count = one.length / 4;
  const found = new Float64Array(count);
  let sum = 0;
  for (let i = 0; i < count; i++) {
    const at = 4 * i;
    found[i] = ciede2000(
      lab(one[at], one[at + 1], one[at + 2]),
      lab(other[at], other[at + 1], other[at + 2]),
    );
    sum += found[i];
  }
  found.sort();
  return { mean: sum / count, high: found[Math.floor(0.95 * (count - 1))] };
}
