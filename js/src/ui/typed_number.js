/**
 * Parse a typed number: with a comma or a point, a proper minus, its unit or a degree sign. A value
 * out of range is clamped, or wrapped if the range is a full circle.
 *
 * @param {string} text
 * @param {Pick<import("../host/types.js").Parameter, "minimum" | "maximum" | "unit">} parameter
 * @returns {number | null} null if it is not a number
 */
export function typedNumber(text, { minimum, maximum, unit }) {
  let bare = text.trim().toLowerCase();
  for (const end of [unit.toLowerCase(), "°"]) {
    if (end && bare.endsWith(end)) bare = bare.slice(0, -end.length).trim();
  }
  const value = Number(bare.replace(",", ".").replace("−", "-"));
  if (bare === "" || !Number.isFinite(value)) return null;
  if (maximum - minimum === 360 && (value < minimum || value > maximum)) {
    return minimum + ((((value - minimum) % 360) + 360) % 360);
  }
  return Math.min(maximum, Math.max(minimum, value));
}
