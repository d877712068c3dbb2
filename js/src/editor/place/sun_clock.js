/**
 * The editor's clock: moves the sun along the path that the kernel computed for the place's day.
 * Without a kernel it keeps using the last path.
 */

import { angleBetween, sunAt } from "../../geometry/day.js";
import { editAt, hoursOfDay, matchHeading, orderly, solarDay } from "../../geometry/place.js";

/**
 * @typedef {import("../../geometry/place.js").Place} Place
 * @typedef {import("../../geometry/day.js").DayRow} DayRow
 * @typedef {{ latitude: number | null, longitude: number | null, heading: number | null,
 *   date: string | null, time: number | null, clock: string | null, notes: string[] }} PhotoPlace
 *   from the photo's metadata
 */

const HOUR = 3_600_000; // milliseconds
const DAY = 24 * HOUR;
const SAME_PLACE = 0.02; // degrees within which the sun counts as on its path

export class SunClock {
  /** @param {import("../types.js").Needs<"model" | "picture" | "state">} needs */
  constructor({ model, picture, state }) {
    this.model = model;
    this.picture = picture;
    this.state = state;
  }

  /** @returns {Place | null} */
  get place() {
    return /** @type {Place | null} */ (this.state.values.place ?? null);
  }

  /** Place and time from the photo's metadata. @returns {Partial<PhotoPlace>} */
  get photoPlace() {
    return this.model.get("_photo_place") ?? {};
  }

  /** The path of the place's day; empty until the kernel has sent it. @returns {DayRow[]} */
  get path() {
    return this.answer().path ?? [];
  }

  /** The kernel's reason why there is no path, or "". */
  get error() {
    return this.answer().error ?? "";
  }

  /** The kernel's answer for this place. @returns {{ path?: DayRow[], error?: string }} */
  answer() {
    const { place } = this;
    const day = this.model.get("_day");
    if (!place || !day?.key) return {};
    const [latitude, longitude, date] = day.key;
    const same =
      latitude === place.latitude && longitude === place.longitude && date === solarDay(place);
    return same ? day : {};
  }

  /** The clock's time in the path's hours. */
  get hours() {
    return this.place ? hoursOfDay(this.place) : 0;
  }

  /** The sun's position at the clock's time. */
  sun() {
    return this.place ? sunAt(this.path, this.hours) : null;
  }

  /** Whether the drawn sun is where the clock puts it. */
  follows() {
    const { place, path } = this;
    if (!place || !path.length) return false;
    const at = editAt(place, path, this.hours);
    const azimuth = Number(at.sun_azimuth ?? this.picture.value("sun_azimuth"));
    const apart = angleBetween(
      [azimuth, Number(at.sun_elevation)],
      [this.picture.value("sun_azimuth"), this.picture.value("sun_elevation")],
    );
    return apart < SAME_PLACE;
  }

  /** Set the clock to an hour of the path; the sun follows. @param {number} hours */
  moveTo(hours) {
    const { place, path } = this;
    if (!place || !path.length) return;
    const [first, last] = [path[0][0], path[path.length - 1][0]];
    // The last row is the next day's first.
    const held = Math.min(last - 1e-3, Math.max(first, hours));
    this.state.set(editAt(place, path, held));
  }

  /** Change place, time or heading as one history step; the sun does not move. @param {Partial<Place>} changes */
  setPlace(changes) {
    const { place } = this;
    if (place) this.state.set({ place: orderly({ ...place, ...changes }) });
  }

  /**
   * Set the photo's place. Unknown fields come from its metadata; without a time it is today at noon.
   *
   * @param {number} latitude
   * @param {number} longitude
   */
  take(latitude, longitude) {
    const { photoPlace: known } = this;
    // Without a time zone, guess it from the longitude as `photo/place.py` does.
    const zone = HOUR * Math.round(longitude / 15);
    const noon = Math.floor(Date.now() / DAY) * DAY + DAY / 2;
    const guess = (known.clock ? Date.parse(`${known.clock}Z`) : noon) - zone;
    const moment = new Date(guess).toISOString();
    const date = known.date ?? moment.slice(0, 10);
    const time = known.time ?? (guess - Date.parse(date)) / HOUR;
    const place = { latitude, longitude, date, time, heading: known.heading ?? null };
    this.state.set({ place: orderly({ ...place, time: Math.round(time * 1e4) / 1e4 }) });
  }

  /** Take place, time and heading from the photo's metadata, as one history step. */
  takeFromFile() {
    const { latitude, longitude } = this.photoPlace;
    if (latitude != null && longitude != null) this.take(latitude, longitude);
  }

  /**
   * Set the clock to a date and time in UTC; the sun follows if the path is known.
   *
   * @param {string} date
   * @param {number} time
   */
  moveToMoment(date, time) {
    const { place, path } = this;
    if (!place) return;
    const days = (Date.parse(date) - Date.parse(place.date)) / DAY;
    const hours = this.hours + 24 * days + time - place.time;
    const known = path.length > 0 && hours >= path[0][0] && hours < path[path.length - 1][0];
    if (known) this.moveTo(hours);
    else this.setPlace({ date, time });
  }

  /** Match the heading to the photo's sun at the clock's time. */
  match() {
    const { place, path } = this;
    const { scene } = this.picture;
    if (!place || !path.length || !scene) return null;
    const { sun_azimuth, sun_elevation } = scene.automatic;
    return matchHeading(place, path, [sun_azimuth, sun_elevation]);
  }
}
