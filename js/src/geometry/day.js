/** The sun's path over a day, from the kernel's table, and refraction. */

/**
 * One row of the kernel's table `_day`: hours UTC, azimuth, apparent and true elevation in degrees.
 *
 * @typedef {[number, number, number, number]} DayRow
 * @typedef {{ azimuth: number, apparent: number, true: number }} SunPlace
 */

const DEGREE = Math.PI / 180;
const UNREFRACTED = -6; // degrees

/** @type {(azimuth: number, elevation: number) => [number, number, number]} */
const vector = (azimuth, elevation) => [
  Math.cos(elevation * DEGREE) * Math.sin(azimuth * DEGREE),
  Math.cos(elevation * DEGREE) * Math.cos(azimuth * DEGREE),
  Math.sin(elevation * DEGREE),
];

/** Wrap an angle to −180 up to 180. @param {number} degrees */
export const turned = (degrees) => ((((degrees + 180) % 360) + 360) % 360) - 180;

/**
 * Return the sun's position at an hour. Neighboring rows are interpolated as unit vectors, as in
 * `geometry/solar.py`, so that neither north nor the zenith is a special case.
 *
 * @param {DayRow[]} day sorted by hour
 * @param {number} hours UTC; clamped to the table
 * @returns {SunPlace | null} null without a table; azimuth −180 to 180
 */
export function sunAt(day, hours) {
  if (day.length < 2) return null;
  const after = day.findIndex((row) => row[0] > hours);
  const next = Math.max(1, after < 0 ? day.length - 1 : after);
  const [low, high] = [day[next - 1], day[next]];
  const share = Math.min(1, Math.max(0, (hours - low[0]) / (high[0] - low[0])));
  const from = vector(low[1], low[2]);
  const to = vector(high[1], high[2]);
  const [east, north, up] = from.map((value, i) => value + share * (to[i] - value));
  return {
    azimuth: Math.atan2(east, north) / DEGREE,
    apparent: Math.atan2(up, Math.hypot(east, north)) / DEGREE,
    true: low[3] + share * (high[3] - low[3]),
  };
}

/** Format hours as 14:05. @param {number} hours 0–24 */
export function clock(hours) {
  const minutes = Math.round(hours * 60);
  return `${String(Math.floor(minutes / 60)).padStart(2, "0")}:${String(minutes % 60).padStart(2, "0")}`;
}

/** Refraction at an apparent elevation (Bennett 1982), degrees. @param {number} apparent degrees */
const refraction = (apparent) =>
  Math.max(1 / Math.tan((apparent + 7.31 / (apparent + 4.4)) * DEGREE), 0) / 60;

/**
 * Return the elevation without refraction, as `geometry/solar.py` does: a sun below −1° is not
 * visible, and refraction fades to zero where civil twilight ends.
 *
 * @param {number} apparent degrees
 */
export function trueElevation(apparent) {
  if (apparent >= -1) return apparent - refraction(apparent);
  const most = refraction(-1);
  const slope = most / (-1 - most - UNREFRACTED);
  const faded = (apparent + UNREFRACTED * slope) / (1 + slope);
  return Math.max(apparent - most, apparent < UNREFRACTED ? apparent : faded);
}

/** Return the angle between two directions in degrees. @type {(a: [number, number], b: [number, number]) => number} */
export function angleBetween([azimuthA, elevationA], [azimuthB, elevationB]) {
  const [a, b] = [elevationA * DEGREE, elevationB * DEGREE];
  // Haversine: acos loses precision near 0°.
  const half =
    Math.sin((a - b) / 2) ** 2 +
    Math.cos(a) * Math.cos(b) * Math.sin(((azimuthA - azimuthB) * DEGREE) / 2) ** 2;
  return (2 * Math.asin(Math.min(1, Math.sqrt(half)))) / DEGREE;
}

const GROUND = 6_360_000; // metres, the shaders' radius of the earth

/** Return the horizon's elevation for a camera above the ground, degrees below level. @param {number} altitude metres */
export const horizonElevation = (altitude) =>
  -Math.acos(GROUND / (GROUND + Math.max(0, altitude))) / DEGREE;
