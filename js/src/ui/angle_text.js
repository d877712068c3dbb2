/** Formats angles for display. */

/** Format degrees with a proper minus sign. @type {(value: number, digits?: number) => string} */
export const degrees = (value, digits = 1) => `${value.toFixed(digits).replace("-", "−")}°`;

/** Format an azimuth relative to the camera's heading. @param {number} azimuth degrees, to the right */
export const aside = (azimuth) => `${degrees(Math.abs(azimuth))} ${azimuth < 0 ? "left" : "right"}`;

/** Format a direction. @param {number} azimuth @param {number} elevation degrees */
export const directionText = (azimuth, elevation) => `${aside(azimuth)} · ${degrees(elevation)}`;

/** Format the sun's position. @param {number} azimuth @param {number} elevation degrees */
export const sunText = (azimuth, elevation) => `Sun ${directionText(azimuth, elevation)} elevation`;
