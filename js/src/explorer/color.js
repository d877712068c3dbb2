/** Converts radiance at four wavelengths, or one wavelength, to screen colors. */

import { encode } from "../gl/srgb.js";
import { SPECTRAL_TO_XYZ, XYZ_TO_REC709 } from "./matrices.js";

/** @typedef {[number, number, number]} Triple */

/** @type {(matrix: number[][], vector: ArrayLike<number>) => Triple} */
const times = (matrix, vector) =>
  /** @type {Triple} */ (
    matrix.map((row) => row.reduce((sum, value, i) => sum + value * vector[i], 0))
  );

/**
 * Return the CIE XYZ of a radiance at 640, 580, 510 and 440 nm in W m⁻² sr⁻¹ nm⁻¹.
 *
 * @param {ArrayLike<number>} radiance
 * @returns {Triple} in kcd m⁻²: Y is the luminance
 */
export const xyzOfSpectrum = (radiance) => times(SPECTRAL_TO_XYZ, radiance);

/** @param {ArrayLike<number>} xyz @returns {Triple} linear Rec. 709; negative outside the gamut */
export const rec709OfXyz = (xyz) => times(XYZ_TO_REC709, xyz);

/** @type {(x: number, y: number) => Triple} XYZ of a chromaticity at luminance 1 */
export const xyzOfChromaticity = (x, y) => [x / y, 1, (1 - x - y) / y];

/** @param {Triple} xyz @returns {[number, number] | null} CIE x, y; null for black */
export function chromaticity([X, Y, Z]) {
  const sum = X + Y + Z;
  return sum > 0 ? [X / sum, Y / sum] : null;
}

/**
 * Format a linear color as CSS, scaled so that its largest channel is `peak`; a color outside the
 * gamut is moved toward gray until it fits.
 *
 * @param {ArrayLike<number>} rgb linear Rec. 709
 * @param {number} [peak] 0–1; 0 keeps the level
 */
export function cssColor(rgb, peak = 1) {
  const [r, g, b] = [rgb[0], rgb[1], rgb[2]];
  const least = Math.min(r, g, b, 0);
  const lifted = [r - least, g - least, b - least];
  const most = Math.max(...lifted, 1e-30);
  const scale = peak > 0 ? peak / most : 1;
  const bytes = lifted.map((value) => Math.round(255 * encode(Math.min(1, value * scale))));
  return `rgb(${bytes.join(" ")})`;
}

/** A lobe of the fit below, with a width on each side. */
const lobe = (
  /** @type {number} */ nm,
  /** @type {number} */ at,
  /** @type {number} */ left,
  /** @type {number} */ right,
) => Math.exp(-0.5 * ((nm - at) * (nm < at ? left : right)) ** 2);

/**
 * CIE 1931 color-matching functions, as fitted by Wyman, Sloan & Shirley, "Simple Analytic
 * Approximations to the CIE XYZ Color Matching Functions", JCGT 2 (2013): within one percent.
 *
 * @param {number} nm
 * @returns {Triple}
 */
export const xyzOfWavelength = (nm) => [
  0.362 * lobe(nm, 442.0, 0.0624, 0.0374) +
    1.056 * lobe(nm, 599.8, 0.0264, 0.0323) -
    0.065 * lobe(nm, 501.1, 0.049, 0.0382),
  0.821 * lobe(nm, 568.8, 0.0213, 0.0247) + 0.286 * lobe(nm, 530.9, 0.0613, 0.0322),
  1.217 * lobe(nm, 437.0, 0.0845, 0.0278) + 0.681 * lobe(nm, 459.0, 0.0385, 0.0725),
];

/** Return the color of one wavelength, darker toward the ends of the visible range. @param {number} nm */
export function wavelengthColor(nm) {
  // No screen shows a pure wavelength: clip it to the gamut.
  const rgb = rec709OfXyz(xyzOfWavelength(nm)).map((value) => Math.max(0, value));
  const most = Math.max(...rgb, 1e-6);
  return cssColor(rgb, most / (most + 0.12));
}

/**
 * Chromaticity of daylight of a correlated color temperature (CIE 15: the D series).
 *
 * @param {number} kelvin 4000–25000
 * @returns {[number, number]}
 */
export function daylight(kelvin) {
  const k = 1000 / kelvin;
  const x =
    kelvin <= 7000
      ? 0.244063 + 0.09911 * k + 2.9678 * k ** 2 - 4.607 * k ** 3
      : 0.23704 + 0.24748 * k + 1.9018 * k ** 2 - 2.0064 * k ** 3;
  return [x, -3 * x * x + 2.87 * x - 0.275];
}
