/**
 * Two traditional measures of haze. Both set the aerosol optical depth; the kernel's twins
 * are `Atmosphere.turbidity` and `Atmosphere.visibility`.
 */

/**
 * The kernel's constants of clean air (trait `_aliases`): extinction at 550 nm and sea level in 1/m,
 * the height in meters above which air thins faster, the share by which its column then shrinks, and
 * Koschmieder's 3.912.
 *
 * @typedef {{ air_extinction_550: number, mesosphere_altitude: number, mesosphere_share: number,
 *   koschmieder: number }} CleanAir
 * @typedef {{ aerosol_optical_depth: number, air_density: number, aerosol_scale_height: number,
 *   rayleigh_scale_height: number }} Air
 */

/** Optical depth of the molecules at 550 nm. @type {(clean: CleanAir, air: Air) => number} */
function molecules(clean, air) {
  const height = air.rayleigh_scale_height;
  const above = Math.exp(-clean.mesosphere_altitude / height);
  const column = height * (1 - (1 - clean.mesosphere_share) * above);
  return clean.air_extinction_550 * air.air_density * column;
}

/** Optical depth of hazy air over that of clean air. @type {(clean: CleanAir, air: Air) => number} */
export function turbidity(clean, air) {
  return 1 + air.aerosol_optical_depth / molecules(clean, air);
}

/** @type {(clean: CleanAir, air: Air, turbidity: number) => number} */
export function depthOfTurbidity(clean, air, value) {
  return Math.max(0, (value - 1) * molecules(clean, air));
}

/** Visibility at sea level in meters. @type {(clean: CleanAir, air: Air) => number} */
export function visibility(clean, air) {
  const aerosol = air.aerosol_optical_depth / air.aerosol_scale_height;
  return clean.koschmieder / (clean.air_extinction_550 * air.air_density + aerosol);
}

/** @type {(clean: CleanAir, air: Air, meters: number) => number} */
export function depthOfVisibility(clean, air, meters) {
  const extinction = clean.koschmieder / meters - clean.air_extinction_550 * air.air_density;
  return Math.max(0, extinction * air.aerosol_scale_height);
}
