/** Describes the photo's sun in words that need no compass. */

/** @typedef {import("../host/types.js").PhotoSun} PhotoSun */

export const DOUBTED = 0.75; // a detection below it is wrong more than one time in four
// The confidence is calibrated on drawn skies; nearly every photo gets a similar value below this.
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
const OVERHEAD = 80; // degrees from which a bearing is meaningless

/** Describe a direction from the photographer's point of view. @param {number} azimuth degrees, to the right */
export const bearingText = (azimuth) => BEARINGS[((Math.round(azimuth / 45) % 8) + 8) % 8];

/** @param {number} elevation degrees */
export function heightText(elevation) {
  const whole = Math.round(Math.abs(elevation));
  if (whole === 0) return "on the horizon";
  return elevation < 0 ? `${whole}° below the horizon` : `${whole}° high`;
}

/** Describe a sun's position. @param {{ azimuth: number, elevation: number }} sun degrees */
export const positionText = ({ azimuth, elevation }) =>
  elevation >= OVERHEAD ? "almost overhead" : `${bearingText(azimuth)}, ${heightText(elevation)}`;

/** Format a confidence in [0, 1]; empty if not measured. @param {number} share */
export function confidenceText(share) {
  if (share >= 1) return "";
  return share >= 0.995 ? "more than 99\u00a0% sure" : `${Math.round(100 * share)}\u00a0% sure`;
}

/** Describe a sun that is marked on the picture. @param {PhotoSun} sun */
export function markText({ source, confidence }) {
  if (source === "told") return "The photo’s sun, set by you";
  return ["The photo’s sun", confidenceText(confidence)].filter(Boolean).join(", ");
}

/**
 * Describe a sun that the picture does not show: its assumed position, and why that matters.
 *
 * A percentage is no help when there is nothing to look at: one word says whether to trust it.
 *
 * @param {PhotoSun} sun
 * @param {{ inside: boolean, live: boolean }} now whether that position lies in the picture, and
 *   whether a kernel can take a better one
 */
export function assumedText(sun, { inside, live }) {
  const told = sun.source === "outside" && "You said that the sun is not in the picture.";
  const start = told || (inside ? "No sun was found." : "No sun is in view.");
  // The confidence applies to the bearing; nothing measures the height.
  const stands =
    sun.confidence >= LIKELY && sun.elevation < OVERHEAD
      ? `probably ${bearingText(sun.azimuth)}, at a guess ${heightText(sun.elevation)}`
      : `assumed to be ${positionText(sun)}, but that is a guess`;
  const ask = live ? ", so mark the sun if you know where it is" : "";
  return `${start} It is ${stands}. Shadows and sky follow from there${ask}.`;
}

/** Describe a detection that may not be the sun. @param {PhotoSun} sun */
export const doubtText = ({ confidence }) =>
  `What is marked as the sun may be something else (${confidenceText(confidence)}). ` +
  "Shadows and sky follow from there.";

/** Describe a sun that has just been marked. @param {PhotoSun} sun */
export const pointedText = (sun) =>
  `The photo’s sun is set: ${positionText(sun)}${sun.visible ? "" : ", out of sight"}.`;
