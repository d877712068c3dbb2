/** Limits of the history's length. */

/** @typedef {import("../host/types.js").Edit} Edit */

export const HISTORY_LENGTH = 100;
// Every step repeats all strokes, and a message of 10 MiB would break the connection.
export const HISTORY_BYTES = 2_000_000;

/** Return the newest steps within the limits. @param {Edit[]} steps */
export function newest(steps) {
  let bytes = 0;
  const kept = steps.slice(-HISTORY_LENGTH).reverse();
  const end = kept.findIndex((recipe, i) => {
    bytes += JSON.stringify(recipe).length;
    return i > 0 && bytes > HISTORY_BYTES;
  });
  return kept.slice(0, end < 0 ? kept.length : end).reverse();
}
