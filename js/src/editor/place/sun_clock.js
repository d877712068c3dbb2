/**
 * The editor's clock: it moves the sun along the path that the kernel computed for the place's day.
 * Without a kernel it goes on with the path that is there.
 */

import { angleBetween, sunAt } from "../../geometry/day.js";
import { editAt, hoursOfDay, matchHeading, orderly, solarDay } from "../../geometry/place.js";

/**
 * @typedef {import("../../geometry/place.js").Place} Place
 * @typedef {import("../../geometry/day.js").DayRow} DayRow
 * @typedef {{ latitude: number | null, longitude: number | null, heading: number | null,
 *   date: string | null, time: number | null, clock: string | null, notes: string[] }} Told what
 *   the photo's file says
 */

const HOUR = 3_600_000; // milliseconds
const DAY = 24 * HOUR;
const SAME_PLACE = 0.02; // degrees between the sun and its path that count as none

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

  /** What the photo's file says. @returns {Partial<Told>} */
  get told() {
    return this.model.get("_photo_place") ?? {};
  }

  /** The path of the place's day; empty until the kernel has sent it. @returns {DayRow[]} */
  get path() {
    return this.answer().path ?? [];
  }

  /** Why there is no path, in the kernel's words. */
  get error() {
    return this.answer().error ?? "";
  }

  /** What the kernel sent for this place. @returns {{ path?: DayRow[], error?: string }} */
  answer() {
    const { place } = this;
    const day = this.model.get("_day");
    if (!place || !day?.key) return {};
    const [latitude, longitude, date] = day.key;
    const same =
      latitude === place.latitude && longitude === place.longitude && date === solarDay(place);
    return same ? day : {};
  }

  /** The clock's hours, as the path counts them. */
  get hours() {
    return this.place ? hoursOfDay(this.place) : 0;
  }

  /** Where the sun stands at the clock's time. */
  sun() {
    return this.place ? sunAt(this.path, this.hours) : null;
  }

  /** Whether the drawn sun stands where the clock puts it. */
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

  /** Turn the clock to an hour of the path: the sun follows. @param {number} hours */
  moveTo(hours) {
    const { place, path } = this;
    if (!place || !path.length) return;
    const [first, last] = [path[0][0], path[path.length - 1][0]];
    // The last row is the next day's first.
    const held = Math.min(last - 1e-3, Math.max(first, hours));
    this.state.set(editAt(place, path, held));
  }

  /** Say where, when or which way anew, as a step; the sun stays. @param {Partial<Place>} changes */
  setPlace(changes) {
    const { place } = this;
    if (place) this.state.set({ place: orderly({ ...place, ...changes }) });
  }

  /**
   * Take a place for the photo: what is not known comes from its file, or else is today at noon.
   *
   * @param {number} latitude
   * @param {number} longitude
   */
  take(latitude, longitude) {
    const { told } = this;
    // Without a zone the clock's is guessed by the longitude, as `photo/place.py` does.
    const zone = HOUR * Math.round(longitude / 15);
    const noon = Math.floor(Date.now() / DAY) * DAY + DAY / 2;
    const guess = (told.clock ? Date.parse(`${told.clock}Z`) : noon) - zone;
    const moment = new Date(guess).toISOString();
    const date = told.date ?? moment.slice(0, 10);
    const time = told.time ?? (guess - Date.parse(date)) / HOUR;
    const place = { latitude, longitude, date, time, heading: told.heading ?? null };
    this.state.set({ place: orderly({ ...place, time: Math.round(time * 1e4) / 1e4 }) });
  }

  /** Take place, time and heading from the photo's file, as a step. */
  takeFromFile() {
    const { latitude, longitude } = this.told;
    if (latitude != null && longitude != null) this.take(latitude, longitude);
  }

  /**
   * Turn the clock to a date and time in UTC: the sun follows where the path is known.
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

  /** The heading by the photo's own sun, taken at the clock's time. */
  match() {
    const { place, path } = this;
    const { scene } = this.picture;
    if (!place || !path.length || !scene) return null;
    const { sun_azimuth, sun_elevation } = scene.automatic;
    return matchHeading(place, path, [sun_azimuth, sun_elevation]);
  }
}
