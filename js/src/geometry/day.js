/** The sun's path over a day, read from the kernel's table; the air's lift of the sun. */

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

/** An angle from −180 up to 180. @param {number} degrees */
export const turned = (degrees) => ((((degrees + 180) % 360) + 360) % 360) - 180;

/**
 * Where the sun is at an hour. Neighbouring rows are mixed as unit vectors, as
 * `geometry/solar.py` does, so that neither north nor the zenith needs care.
 *
 * @param {DayRow[]} day sorted by hour
 * @param {number} hours UTC; held at the ends of the table
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

/** Hours as 14:05. @param {number} hours 0–24 */
export function clock(hours) {
  const minutes = Math.round(hours * 60);
  return `${String(Math.floor(minutes / 60)).padStart(2, "0")}:${String(minutes % 60).padStart(2, "0")}`;
}

/** How far the air lifts what is seen at an elevation: Bennett 1982. @param {number} apparent degrees */
const lift = (apparent) =>
  Math.max(1 / Math.tan((apparent + 7.31 / (apparent + 4.4)) * DEGREE), 0) / 60;

/**
 * The elevation without the air's lift, as `geometry/solar.py` has it: a sun below −1° is not
 * seen, and the lift fades to none where civil twilight ends.
 *
 * @param {number} apparent degrees
 */
export function trueElevation(apparent) {
  if (apparent >= -1) return apparent - lift(apparent);
  const most = lift(-1);
  const slope = most / (-1 - most - UNREFRACTED);
  const faded = (apparent + UNREFRACTED * slope) / (1 + slope);
  return Math.max(apparent - most, apparent < UNREFRACTED ? apparent : faded);
}

/** The angle between two directions. @type {(a: [number, number], b: [number, number]) => number} */
export function angleBetween([azimuthA, elevationA], [azimuthB, elevationB]) {
  const [a, b] = [elevationA * DEGREE, elevationB * DEGREE];
  // Haversine: acos has no digits left near 0°.
  const half =
    Math.sin((a - b) / 2) ** 2 +
    Math.cos(a) * Math.cos(b) * Math.sin(((azimuthA - azimuthB) * DEGREE) / 2) ** 2;
  return (2 * Math.asin(Math.min(1, Math.sqrt(half)))) / DEGREE;
}

const GROUND = 6_360_000; // metres, the shaders' radius of the earth

/** Where the ground ends for a camera above it: below the level. @param {number} altitude metres */
export const horizonElevation = (altitude) =>
  -Math.acos(GROUND / (GROUND + Math.max(0, altitude))) / DEGREE;
