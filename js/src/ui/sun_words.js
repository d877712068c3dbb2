/** What the editor says of the photo's own sun, in words that need no compass. */

/** @typedef {import("../host/types.js").PhotoSun} PhotoSun */

export const DOUBTED = 0.75; // a found sun below it is wrong more than once in four times
// Calibrated on drawn skies, it says much the same of nearly every photo, and less than this.
export const LIKELY = 0.95;

const BEARINGS = [
  "ahead",
  "ahead to the right",
  "to the right",
  "behind the camera to the right",
  "behind the camera",
  "behind the camera to the left",
  "to the left",
  "ahead to the left",
];
const OVERHEAD = 80; // degrees from which a bearing says nothing

/** A direction as somebody who holds the camera says it. @param {number} azimuth degrees, to the right */
export const bearingText = (azimuth) => BEARINGS[((Math.round(azimuth / 45) % 8) + 8) % 8];

/** @param {number} elevation degrees */
export function heightText(elevation) {
  const whole = Math.round(Math.abs(elevation));
  if (whole === 0) return "on the horizon";
  return elevation < 0 ? `${whole}° below the horizon` : `${whole}° high`;
}

/** Where a sun stands. @param {{ azimuth: number, elevation: number }} sun degrees */
export const whereText = ({ azimuth, elevation }) =>
  elevation >= OVERHEAD ? "almost overhead" : `${bearingText(azimuth)}, ${heightText(elevation)}`;

/** How sure a measured share of [0, 1] is; empty where nothing measured it. @param {number} share */
export function sureText(share) {
  if (share >= 1) return "";
  return share >= 0.995 ? "more than 99\u00a0% sure" : `${Math.round(100 * share)}\u00a0% sure`;
}

/** Of a sun that is marked on the picture. @param {PhotoSun} sun */
export function markText({ source, confidence }) {
  if (source === "told") return "The photo’s sun, set by you";
  return ["The photo’s sun", sureText(confidence)].filter(Boolean).join(", ");
}

/**
 * Of a sun that the picture does not show: where it is taken to be, and why that matters.
 *
 * A percentage is no help where nothing can be looked at: one word says whether to believe it.
 *
 * @param {PhotoSun} sun
 * @param {{ inside: boolean, live: boolean }} now whether that place lies in the picture, and
 *   whether there is a kernel that could be told a better one
 */
export function assumedText(sun, { inside, live }) {
  const told = sun.source === "outside" && "You said that the sun is not in the picture.";
  const start = told || (inside ? "No sun was found." : "No sun is in view.");
  // What is measured is how likely the bearing is right; nothing measures the height.
  const stands =
    sun.confidence >= LIKELY && sun.elevation < OVERHEAD
      ? `probably ${bearingText(sun.azimuth)}, at a guess ${heightText(sun.elevation)}`
      : `assumed to be ${whereText(sun)}, but that is a guess`;
  const ask = live ? ", so mark the sun if you know where it is" : "";
  return `${start} It is ${stands}. Shadows and sky follow from there${ask}.`;
}

/** Of a sun that was found and may be none. @param {PhotoSun} sun */
export const doubtText = ({ confidence }) =>
  `What is marked as the sun may be something else (${sureText(confidence)}). ` +
  "Shadows and sky follow from there.";

/** Of a place that has just been pointed at. @param {PhotoSun} sun */
export const pointedText = (sun) =>
  `The photo’s sun is set: ${whereText(sun)}${sun.visible ? "" : ", out of sight"}.`;
