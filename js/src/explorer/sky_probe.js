/** Reads the sky in single directions: under the pointer, and where a scan measured it. */

import { chromaticity, rec709OfXyz, xyzOfSpectrum } from "./color.js";

/**
 * @typedef {import("../host/types.js").Point} Point
 * @typedef {{ radiance: number[], luminance: number, xy: [number, number] | null,
 *   rgb: number[] }} Reading luminance in kcd m⁻², color in linear Rec. 709
 */

/** @param {ArrayLike<number>} radiance at the four wavelengths @returns {Reading} */
export function reading(radiance) {
  const xyz = xyzOfSpectrum(radiance);
  return {
    radiance: [...Array.from(radiance)],
    luminance: Math.max(0, xyz[1]),
    xy: chromaticity(xyz),
    rgb: rec709OfXyz(xyz),
  };
}

/** Format a luminance. @param {number} kcd kcd m⁻² */
export function luminanceText(kcd) {
  const [value, unit] =
    kcd >= 1 ? [kcd, "kcd/m²"] : kcd >= 1e-3 ? [1e3 * kcd, "cd/m²"] : [1e6 * kcd, "mcd/m²"];
  return `${Number(value.toPrecision(3))} ${unit}`;
}

/** Relative error of the model: its luminance over the measured one, minus one. */
export const relativeError = (
  /** @type {ArrayLike<number>} */ computed,
  /** @type {ArrayLike<number>} */ measured,
) => xyzOfSpectrum(computed)[1] / Math.max(xyzOfSpectrum(measured)[1], 1e-12) - 1;

// Blue: too dark; orange: too bright. A diverging scale that is safe for color blindness.
const STOPS = [
  [-0.5, [20, 60, 160]],
  [-0.2, [110, 160, 230]],
  [0, [250, 250, 250]],
  [0.2, [250, 170, 70]],
  [0.5, [190, 60, 0]],
];

/** @param {number} error clamped to ±0.5 */
export function errorColor(error) {
  const held = Math.min(0.5, Math.max(-0.5, error));
  const next = Math.max(
    1,
    STOPS.findIndex(([at]) => held <= Number(at)),
  );
  const [low, from] = /** @type {[number, number[]]} */ (STOPS[next - 1]);
  const [high, to] = /** @type {[number, number[]]} */ (STOPS[next]);
  const share = (held - low) / (high - low);
  return `rgb(${from.map((value, i) => Math.round(value + share * (to[i] - value))).join(" ")})`;
}

/** The same colors as a CSS background. */
export const ERROR_GRADIENT = `linear-gradient(to right, ${STOPS.map(
  ([at, rgb]) => `rgb(${/** @type {number[]} */ (rgb).join(" ")}) ${100 * (Number(at) + 0.5)}%`,
).join(", ")})`;
