/**
 * The curve passes' values as arrays for plots. Texel i of each pass belongs to the abscissa below;
 * `shaders/explorer.json` has the sizes.
 */

/** @typedef {Float32Array | number[]} Numbers */

/** Channel `c` of RGBA texels. @type {(texels: Numbers, c: number) => number[]} */
export const channel = (texels, c) => {
  const list = [];
  for (let i = c; i < texels.length; i += 4) list.push(texels[i]);
  return list;
};

/** @type {(n: number, at: (i: number) => number) => number[]} */
const range = (n, at) => Array.from({ length: n }, (_, i) => at(i));

/** Nanometres of `curve_transmittance`. */
export const WAVELENGTHS = range(64, (i) => 380 + (i * 400) / 63);
/** Sun's elevations in degrees of `curve_sun`. */
export const SUN_ELEVATIONS = range(96, (i) => -1 + 91 * (i / 95) ** 2);
/** Degrees along the principal plane of `curve_principal_plane`; 90 is the zenith. */
export const PLANE_ANGLES = range(181, (i) => i);
/** Sun's elevations in degrees of `curve_zenith`. */
export const ZENITH_ELEVATIONS = range(81, (i) => -12 + i / 2);

/**
 * Logarithmic polar coordinates: angle 0 points to the right, the radius grows by 1 a decade.
 *
 * @param {Numbers} values by whole degrees 0–180
 * @param {number} lowest decade at the center, for instance −3
 * @returns {{ x: number[], y: number[] }} both halves, closed
 */
export function polar(values, lowest) {
  const [x, y] = [/** @type {number[]} */ ([]), /** @type {number[]} */ ([])];
  const last = values.length - 1;
  for (let i = 0; i <= 2 * last; i++) {
    const degrees = i <= last ? i : 2 * last - i;
    const radius = Math.max(0, Math.log10(Math.max(values[degrees], 1e-30)) - lowest);
    const angle = (degrees * Math.PI) / 180;
    x.push(radius * Math.cos(angle));
    y.push(radius * Math.sin(angle) * (i <= last ? 1 : -1));
  }
  return { x, y };
}

/** Return the whole decades that contain all positive values. @param {Numbers[]} lists @returns {[number, number]} */
export function decades(...lists) {
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const value of lists.flatMap((list) => [...list])) {
    if (!(value > 0)) continue;
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  if (!(high > 0)) return [-3, 0];
  return [Math.floor(Math.log10(low)), Math.ceil(Math.log10(high) + 1e-9)];
}

/**
 * Interpolate a curve at ascending abscissae.
 *
 * @param {Numbers} at
 * @param {Numbers} values
 * @param {number} where clamped to the ends
 */
export function sample(at, values, where) {
  let high = 1;
  while (high < at.length - 1 && at[high] < where) high += 1;
  const share = (where - at[high - 1]) / (at[high] - at[high - 1]);
  const held = Math.min(1, Math.max(0, share));
  return values[high - 1] + held * (values[high] - values[high - 1]);
}

/**
 * Project a direction onto the principal plane.
 *
 * @param {number} azimuth degrees from the sun's, −180 to 180
 * @param {number} elevation degrees
 * @returns {{ angle: number, away: number }} degrees along the plane from the horizon below the
 *   sun, and away from it
 */
export function onPrincipalPlane(azimuth, elevation) {
  const [a, e] = [(azimuth * Math.PI) / 180, (elevation * Math.PI) / 180];
  const [ahead, side, up] = [Math.cos(a) * Math.cos(e), Math.sin(a) * Math.cos(e), Math.sin(e)];
  return {
    angle: (Math.atan2(up, ahead) * 180) / Math.PI,
    away: (Math.asin(Math.min(1, Math.abs(side))) * 180) / Math.PI,
  };
}

/**
 * Return the direction at an angle along the principal plane.
 *
 * @param {number} angle degrees from the horizon below the sun
 * @param {number} sunAzimuth degrees
 * @returns {[number, number]} azimuth and elevation in degrees
 */
export const planeDirection = (angle, sunAzimuth) =>
  angle <= 90 ? [sunAzimuth, angle] : [sunAzimuth + 180, 180 - angle];
