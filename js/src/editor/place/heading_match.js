/** Sets the heading from the photo's sun: a button, its result, and the times that fit. */

import { clock as clockText } from "../../geometry/day.js";
import { AGREES, hoursOfDay } from "../../geometry/place.js";
import { chip } from "../../ui/chips.js";
import { element } from "../../ui/element.js";

/** @typedef {import("../../geometry/place.js").Place} Place */

/** @param {import("../types.js").Needs<"clock" | "picture" | "state">} needs */
export function headingMatch({ clock, picture, state }) {
  const button = chip(
    "Match the photo's sun",
    "Set the heading so that the photo's sun agrees with place and time; " +
      "set the clock to the photo's time first",
    () => match(),
  );
  const note = element("p", { class: "sw-hint", role: "status", hidden: true });
  const offers = element("div", { class: "sw-chips", hidden: true });
  let about = ""; // the place that the note is about: it disappears when that changes

  /** @param {string} text @param {Place[]} [places] times to offer */
  function say(text, places = []) {
    about = key(clock.place);
    note.textContent = text;
    note.hidden = !text;
    offers.hidden = !places.length;
    offers.replaceChildren(...places.map((place, i) => offer(place, i === 0 ? clock.hours : null)));
  }

  /** @param {Place} place @param {number | null} now the clock's hours, for the nearest offer */
  const offer = (place, now) =>
    chip(
      `${clockText(place.time)} UTC${now === null ? "" : shift(hoursOfDay(place) - now)}`,
      "Use this as the photo's time, with its heading",
      () => {
        state.set({ place });
        say("");
      },
    );

  function match() {
    const found = clock.match();
    const { scene } = picture;
    if (!found || !scene) return;
    clock.setPlace({ heading: found.place.heading });
    const { mismatch, agreeing } = found;
    const apart = Math.abs(mismatch).toFixed(1);
    const guess = scene.sun?.visible
      ? ""
      : "The photo does not show its sun: its position is a guess, and so is the heading. ";
    if (Math.abs(mismatch) <= AGREES) {
      return say(`${guess}Time and place agree with the photo's sun to within ${apart}°.`);
    }
    const side = mismatch > 0 ? "higher" : "lower";
    const than = `than at ${clockText(found.place.time)} UTC`;
    const start = `${guess}The photo's sun is ${apart}° ${side} ${than}. `;
    if (agreeing.length) {
      const question = "Is the clock or its time zone wrong? The elevations agree at:";
      return say(start + question, agreeing);
    }
    const level = scene.automatic.sun_elevation.toFixed(1);
    say(`${start}On this day the sun is never at ${level}°: check the date and place.`);
  }

  return {
    button,
    nodes: [note, offers],
    say,
    show() {
      const ready = clock.path.length > 0 && picture.scene !== null;
      button.disabled = !ready;
      button.classList.toggle("sw-primary", ready && clock.place?.heading === null);
      if (about !== key(clock.place)) say("");
    },
  };
}

/** Describe a difference that looks like a time zone error, a whole number of hours, or "". @param {number} hours */
function shift(hours) {
  const whole = Math.round(hours);
  if (whole === 0 || Math.abs(hours - whole) > 0.2) return "";
  return `, ${Math.abs(whole)} h ${whole > 0 ? "later" : "earlier"}`;
}

/** Identify a place apart from its time. @param {Place | null} place */
const key = (place) =>
  JSON.stringify(place && [place.latitude, place.longitude, place.date, place.heading]);
