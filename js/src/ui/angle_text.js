/** Angles as a person reads them. */

/** Degrees with a proper minus. @type {(value: number, digits?: number) => string} */
export const degrees = (value, digits = 1) => `${value.toFixed(digits).replace("-", "−")}°`;

/** An azimuth from the camera's heading. @param {number} azimuth degrees, to the right */
export const aside = (azimuth) => `${degrees(Math.abs(azimuth))} ${azimuth < 0 ? "left" : "right"}`;

/** A direction. @param {number} azimuth @param {number} elevation degrees */
export const directionText = (azimuth, elevation) => `${aside(azimuth)} · ${degrees(elevation)}`;

/** Where the sun is. @param {number} azimuth @param {number} elevation degrees */
export const sunText = (azimuth, elevation) => `Sun ${directionText(azimuth, elevation)} elevation`;
