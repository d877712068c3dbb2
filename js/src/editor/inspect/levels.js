/** Counts a picture's levels (red, green, blue, luminance) and its clipped pixels. */

import { encode, LIGHT } from "../../gl/srgb.js";

export const BINS = 64;
const PER_BIN = 256 / BINS;

/**
 * @typedef {{
 *   red: number[], green: number[], blue: number[], luminance: number[],
 *   clipped: { black: number, white: number },
 * }} Levels shares of the pixels by bin, dark to light, and of the clipped pixels
 */

/** The sRGB level of 4096 steps of linear light. */
const LEVEL = Uint8Array.from({ length: 4096 }, (_, step) => Math.round(255 * encode(step / 4095)));

/**
 * Count the levels of RGBA bytes in sRGB. Luminance is Rec. 709's of linear light, encoded like the
 * channels.
 *
 * @param {Uint8ClampedArray} pixels
 * @returns {Levels}
 */
export function countLevels(pixels) {
  const counts = Array.from({ length: 4 }, () => new Array(BINS).fill(0));
  let black = 0;
  let white = 0;
  const total = pixels.length / 4;
  for (let i = 0; i < pixels.length; i += 4) {
    const [r, g, b] = [pixels[i], pixels[i + 1], pixels[i + 2]];
    const light = 0.2126 * LIGHT[r] + 0.7152 * LIGHT[g] + 0.0722 * LIGHT[b];
    const luminance = LEVEL[Math.round(4095 * light)];
    counts[0][Math.floor(r / PER_BIN)] += 1;
    counts[1][Math.floor(g / PER_BIN)] += 1;
    counts[2][Math.floor(b / PER_BIN)] += 1;
    counts[3][Math.floor(luminance / PER_BIN)] += 1;
    // A pixel clips at the top if any channel does, at the bottom if all do.
    if (r === 255 || g === 255 || b === 255) white += 1;
    if (r === 0 && g === 0 && b === 0) black += 1;
  }
  const [red, green, blue, luminance] = counts.map((bins) => bins.map((n) => n / (total || 1)));
  const clipped = { black: black / (total || 1), white: white / (total || 1) };
  return { red, green, blue, luminance, clipped };
}

/**
 * Return the share of levels in each bin.
 *
 * @param {Uint8Array} levels
 * @returns {number[]}
 */
export function spreadOf(levels) {
  const bins = new Array(BINS).fill(0);
  for (const level of levels) bins[Math.floor(level / PER_BIN)] += 1;
  return bins.map((n) => n / (levels.length || 1));
}

/**
 * Return a height that shows nearly all of several histograms: a peak from the sky's flat blue, or
 * from clipped white, would flatten everything else.
 *
 * @param {number[][]} histograms
 */
export function ceiling(histograms) {
  const inner = histograms.flatMap((bins) => bins.slice(1, -1)).sort((a, b) => b - a);
  return Math.max(1e-6, inner[Math.floor(inner.length * 0.02)] ?? 0);
}

/**
 * A histogram as a filled path, `width` × `height`.
 *
 * @param {number[]} bins
 * @param {number} most the share that reaches the top
 * @param {number} width
 * @param {number} height
 */
export function hill(bins, most, width, height) {
  const points = bins.map((share, i) => {
    const x = ((i + 0.5) / bins.length) * width;
    const y = height * (1 - Math.min(1, share / most));
    return `${x.toFixed(1)} ${y.toFixed(1)}`;
  });
  return `M0 ${height}L${points.join("L")}L${width} ${height}Z`;
}
