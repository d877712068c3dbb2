/** Conversion between sRGB code values and linear light (IEC 61966-2-1). */

/** @param {number} code 0–1 @returns {number} linear light, 0–1 */
const decode = (code) => (code <= 0.04045 ? code / 12.92 : ((code + 0.055) / 1.055) ** 2.4);

/** @param {number} light 0–1, linear @returns {number} 0–1 */
export const encode = (light) =>
  light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055;

/** Linear light of each of the 256 levels. */
export const LIGHT = Float64Array.from({ length: 256 }, (_, level) => decode(level / 255));
