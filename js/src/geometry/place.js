/**
 * A photo's place, time and heading, and the sun's position, read from the kernel's path of a day:
 * twins of `sunwidget/geometry/place.py` and `sunwidget/analysis/heading.py`.
 */

import { sunAt, turned } from "./day.js";

/**
 * Degrees, day in UTC as YYYY-MM-DD, hours UTC; a heading of null is unknown.
 *
 * @typedef {{ latitude: number, longitude: number, date: string, time: number,
 *   heading: number | null }} Place
 * @typedef {import("./day.js").DayRow} DayRow
 * @typedef {{ place: Place, mismatch: number, agreeing: Place[] }} HeadingMatch
 */

const LOWEST = -12; // lowest elevation of an edit
const DAY = 86_400_000; // milliseconds
export const AGREES = 3; // degrees: the accuracy of horizon and field of view

/** @param {string} date @param {number} days */
const later = (date, days) => new Date(Date.parse(date) + days * DAY).toISOString().slice(0, 10);

/** Round a value as recipes do. @param {number} value */
const rounded = (value) => Math.round(value * 1e4) / 1e4;

/** Return a place with its fields in the kernel's order. @param {Place} place @returns {Place} */
export const orderly = ({ latitude, longitude, date, time, heading }) => ({
  latitude,
  longitude,
  date,
  time,
  heading,
});

/** Return the solar day, midnight to midnight, of a place's time. @param {Place} place */
export const solarDay = ({ longitude, date, time }) =>
  later(date, Math.floor((time + longitude / 15) / 24));

/** Return a place's time in the path's hours, from UTC midnight of the solar day. @param {Place} place */
export const hoursOfDay = (place) =>
  place.time + (24 * (Date.parse(place.date) - Date.parse(solarDay(place)))) / DAY;

/** Return the place at a time in the path's hours; the UTC date follows. @param {Place} place @param {number} hours @returns {Place} */
export function atHours(place, hours) {
  const days = Math.floor(hours / 24);
  const time = rounded(hours - 24 * days);
  return orderly({ ...place, date: later(solarDay(place), days), time });
}

/** Hours of local mean solar time, 0–24. @param {Place} place */
export const solarTime = ({ longitude, time }) => (((time + longitude / 15) % 24) + 24) % 24;

/**
 * Return an edit's changes for an hour of the path; the twin of `Edit.at`.
 *
 * @param {Place} place
 * @param {DayRow[]} path
 * @param {number} hours
 * @returns {Record<string, unknown>}
 */
export function editAt(place, path, hours) {
  const sun = sunAt(path, hours);
  if (!sun) return {};
  /** @type {Record<string, unknown>} */
  const edit = {
    place: atHours(place, hours),
    sun_elevation: rounded(Math.max(sun.apparent, LOWEST)),
  };
  if (place.heading !== null) edit.sun_azimuth = rounded(turned(sun.azimuth - place.heading));
  return edit;
}

/**
 * Find the heading at which the photo's sun agrees with time and place.
 *
 * @param {Place} place
 * @param {DayRow[]} path
 * @param {[number, number]} seen azimuth from the camera's axis, and apparent elevation
 * @returns {HeadingMatch} `agreeing` are the times of that day at which the elevations agree
 */
export function matchHeading(place, path, [azimuth, elevation]) {
  const now = hoursOfDay(place);
  /** @param {number} hours @returns {Place} */
  const facing = (hours) => {
    const north = sunAt(path, hours)?.azimuth ?? 0;
    const heading = rounded((((north - azimuth) % 360) + 360) % 360) % 360;
    return { ...atHours(place, hours), heading };
  };
  const times = crossings(path, elevation).sort((a, b) => Math.abs(a - now) - Math.abs(b - now));
  return {
    place: { ...facing(now), date: place.date, time: place.time },
    mismatch: elevation - Math.max(sunAt(path, now)?.apparent ?? 0, LOWEST),
    agreeing: times.map(facing),
  };
}

/** Return the hours at which the elevation crosses a level. @param {DayRow[]} path @param {number} level */
function crossings(path, level) {
  const found = [];
  for (let i = 1; i < path.length; i++) {
    const [before, after] = [path[i - 1][2] - level, path[i][2] - level];
    if (before * after >= 0) continue;
    const share = before / (before - after);
    found.push(path[i - 1][0] + share * (path[i][0] - path[i - 1][0]));
  }
  return found;
}
