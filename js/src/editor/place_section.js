/** Where and when: the clock that plays the day, the place, and the heading by the photo's sun. */

import { button } from "../controls/button.js";
import { chip } from "../controls/chips.js";
import { element } from "../controls/element.js";
import { icon } from "../controls/icons.js";
import { section } from "../controls/section.js";
import { toggle } from "../controls/toggle.js";
import { clock as clockText, sunAt, turned } from "../day.js";
import { AGREES, solarTime } from "../place.js";
import { dayStrip } from "./day_strip.js";
import { SunClock } from "./sun_clock.js";
import { SunPath } from "./sun_path.js";

/**
 * @typedef {import("../place.js").Place} Place
 * @typedef {import("./sun_tool.js").SunTool} SunTool
 */

const HOURS_A_SECOND = 1; // while the day plays
const NIGHT = -12; // degrees below which nothing changes any more

/** @type {import("./parts.js").MakePart} */
export function placeSection(view, signal) {
  const { state } = view;
  const clock = new SunClock(view);
  const path = new SunPath(view, clock);
  /** @type {SunTool} */ (view.tools.sun).track = path;

  const strip = dayStrip({
    onBegin: () => state.begin(),
    onInput: (hours) => clock.moveTo(hours),
    onCommit: () => state.commit(),
  });
  const play = button({
    icon: "play",
    label: "Play the day",
    title: "Play the day, an hour a second; the night is passed over",
    onClick: () => (frame ? stop() : start()),
  });
  const time = field("Time, UTC", {
    type: "text",
    inputmode: "numeric",
    autocomplete: "off",
    spellcheck: "false",
    title: "Hours and minutes in UTC, as 17:30",
  });
  const date = field("Date, UTC", { type: "date" });
  const coordinates = /** @type {const} */ (["latitude", "longitude"]).map((name) => {
    const limit = name === "latitude" ? 90 : 180;
    const title = name === "latitude" ? "Degrees, north positive" : "Degrees, east positive";
    const made = field(name === "latitude" ? "Latitude" : "Longitude", {
      type: "number",
      min: -limit,
      max: limit,
      step: "any",
      placeholder: "°",
      title,
    });
    return { name, limit, ...made };
  });
  const heading = field("Heading", {
    type: "number",
    min: 0,
    max: 360,
    step: "any",
    placeholder: "unknown",
    title: "Where the camera looks, degrees clockwise from true north",
  });

  const fromPhoto = chip(
    "From the photo",
    "Place, time and heading as the photo's file has them",
    () => fromFile(),
  );
  const photoTime = chip("Photo's time", "The clock back to when the photo was taken", () =>
    toMoment(clock.told.date, clock.told.time),
  );
  const bySun = chip(
    "By the photo's sun",
    "Set the heading so that the photo's own sun stands where place and time put it; " +
      "the clock must stand at the photo's time",
    () => match(),
  );
  const said = element("p", { class: "sw-hint sw-place-said" });
  const missing = element("p", { class: "sw-hint", hidden: true });
  const note = element("p", { class: "sw-hint sw-place-note", role: "status", hidden: true });
  const offers = element("div", { class: "sw-chips", hidden: true });
  const shown = toggle({
    parameter: {
      name: "",
      label: "Path on the picture",
      help: "The sun's way over the day, with the hours in UTC. Drag along it to move the clock.",
      default: true,
    },
    onChange: (on) => {
      path.shown = on;
      view.show();
    },
  });
  const kept = toggle({
    parameter: {
      name: "",
      label: "Keep the sun on it",
      help: "Dragging the sun, and its arrow keys, then move the clock",
      default: false,
    },
    onChange: (on) => {
      path.kept = on;
      view.show();
    },
  });

  const day = element(
    "div",
    { class: "sw-day" },
    element("div", { class: "sw-day-row" }, play, strip.node),
    said,
    shown.node,
    kept.node,
  );
  const body = [
    day,
    element(
      "div",
      { class: "sw-clock-place" },
      ...coordinates.map(({ node }) => node),
      date.node,
      time.node,
      heading.node,
      bySun,
    ),
    element("div", { class: "sw-chips sw-place-chips" }, fromPhoto, photoTime),
    missing,
    note,
    offers,
  ];
  const node = section(
    { title: "Time and place", open: Boolean(clock.place), className: "sw-more sw-clock" },
    ...body,
  );
  view.panel.section("sun").append(node);

  // --- what the fields say ---------------------------------------------------------------

  for (const one of coordinates) {
    one.input.addEventListener("change", () => {
      if (!one.input.checkValidity()) {
        one.input.reportValidity();
        return;
      }
      const [latitude, longitude] = coordinates.map(({ input }) =>
        input.value === "" ? null : Number(input.value),
      );
      if (latitude === null || longitude === null) {
        if (clock.place && coordinates.every(({ input }) => input.value === ""))
          state.set({ place: null });
      } else if (clock.place) clock.setPlace({ latitude, longitude });
      else clock.take(latitude, longitude);
    });
  }
  date.input.addEventListener("change", () => {
    if (date.input.value) clock.setPlace({ date: date.input.value });
  });
  time.input.addEventListener("change", () => {
    const [, hours, minutes = "0"] =
      /^\s*(\d{1,2})(?:[:.h ]?([0-5]\d))?\s*$/.exec(time.input.value) ?? [];
    const value = Number(hours) + Number(minutes) / 60;
    if (clock.place && value <= 24) toMoment(clock.place.date, value);
    else view.show();
  });
  heading.input.addEventListener("change", () => {
    const { value } = heading.input;
    if (!heading.input.checkValidity()) heading.input.reportValidity();
    else clock.setPlace({ heading: value === "" ? null : Number(value) % 360 });
  });

  /** Turn the clock to a moment, the sun with it where the path is known. @type {(date?: string | null, time?: number | null) => void} */
  function toMoment(newDate, newTime) {
    const { place } = clock;
    if (!place || newDate == null || newTime == null) return;
    const hours = clock.hours + 24 * days(place.date, newDate) + newTime - place.time;
    const row = clock.path;
    const known = row.length > 0 && hours >= row[0][0] && hours < row[row.length - 1][0];
    if (known) clock.moveTo(hours);
    else clock.setPlace({ date: newDate, time: newTime });
  }

  function fromFile() {
    const { latitude, longitude } = clock.told;
    if (latitude == null || longitude == null) return;
    state.begin();
    state.set({ place: null });
    clock.take(latitude, longitude);
    state.commit();
    say(clock.told.notes?.join(" ") ?? "");
  }

  // --- the heading by the photo's sun ----------------------------------------------------

  function match() {
    const found = clock.match();
    const { scene } = view;
    if (!found || !scene) return;
    clock.setPlace({ heading: found.place.heading });
    const { mismatch, agreeing } = found;
    const guess = scene.sun?.visible
      ? ""
      : "The photo does not show its sun: where it stood is a guess, and so is the heading. ";
    if (Math.abs(mismatch) <= AGREES) {
      say(
        `${guess}Time and place agree with the photo's sun to ${Math.abs(mismatch).toFixed(1)}°.`,
      );
      return;
    }
    const way = mismatch > 0 ? "higher" : "lower";
    const start = `${guess}The photo's sun stands ${Math.abs(mismatch).toFixed(1)}° ${way} than at ${clockText(found.place.time)} UTC. `;
    const level = scene.automatic.sun_elevation.toFixed(1);
    say(
      agreeing.length
        ? `${start}Is the clock or its time zone wrong? The elevations agree at:`
        : `${start}On this day it never stands at ${level}°: check date and place.`,
      agreeing,
    );
  }

  let about = ""; // what the note is about: said no longer when that has changed
  /** @param {string} text @param {Place[]} [places] times that are offered */
  function say(text, places = []) {
    about = key(clock.place);
    note.textContent = text;
    note.hidden = !text;
    offers.hidden = !places.length;
    offers.replaceChildren(
      ...places.map((place) =>
        chip(
          `${clockText(place.time)} UTC`,
          "Take this as the photo's time, with its heading",
          () => {
            state.set({ place });
            say("");
          },
        ),
      ),
    );
  }

  // --- playing ---------------------------------------------------------------------------

  let frame = 0;
  let last = 0;
  const tick = (/** @type {number} */ now) => {
    const passed = Math.min(0.2, (now - last) / 1000);
    last = now;
    // Another gesture ends a step of the history; the playing goes on in the next.
    state.begin();
    clock.moveTo(awake(clock.hours + passed * HOURS_A_SECOND));
    frame = requestAnimationFrame(tick);
  };
  /** The hour itself, or the end of the night that it is in. @param {number} hours */
  const awake = (hours) => {
    const row = clock.path;
    const [first, end] = [row[0][0], row[row.length - 1][0]];
    const at = hours >= end ? first : hours;
    const sun = sunAt(row, at);
    if (!sun || sun.apparent > NIGHT) return at;
    const lit = row.filter(([, , up]) => up > NIGHT).map(([hour]) => hour);
    return lit.find((hour) => hour > at) ?? lit[0] ?? at;
  };
  const start = () => {
    last = performance.now();
    frame = requestAnimationFrame(tick);
    showPlay();
  };
  const stop = () => {
    cancelAnimationFrame(frame);
    frame = 0;
    state.commit();
    showPlay();
  };
  const showPlay = () => {
    play.setAttribute("aria-pressed", String(frame !== 0));
    play.replaceChildren(icon(frame ? "pause" : "play"));
  };
  showPlay();
  signal.addEventListener("abort", () => cancelAnimationFrame(frame));

  // --- from the kernel -------------------------------------------------------------------

  const arrived = () => view.show();
  for (const name of ["_day", "_photo_place"]) view.model.on(`change:${name}`, arrived);
  signal.addEventListener("abort", () => {
    for (const name of ["_day", "_photo_place"]) view.model.off(`change:${name}`, arrived);
  });

  return {
    show() {
      const { place, told } = clock;
      const row = clock.path;
      const asks = view.kernel.answers ? "" : "Needs the kernel: the day's path comes from it";
      if (about !== key(place)) say("");
      for (const { name, input } of coordinates) fill(input, place?.[name]);
      fill(date.input, place?.date);
      fill(time.input, place ? clockText(place.time) : null);
      fill(heading.input, place?.heading == null ? null : Number(place.heading.toFixed(1)));
      for (const { input } of [...coordinates, date]) {
        input.disabled = asks !== "" || (input === date.input && !place);
        if (asks) input.title = asks;
      }
      time.input.disabled = heading.input.disabled = !place;
      const located = told.latitude != null && told.longitude != null;
      fromPhoto.hidden = !located;
      fromPhoto.disabled = asks !== "";
      fromPhoto.classList.toggle("sw-primary", located && !place);
      photoTime.hidden = told.time == null || !place;
      bySun.disabled = !row.length || !view.scene;
      bySun.classList.toggle("sw-primary", row.length > 0 && place?.heading == null);

      day.hidden = !row.length;
      missing.textContent = whatIsMissing(asks, located);
      missing.hidden = missing.textContent === "";
      if (!place || !row.length) {
        if (frame) stop();
        return;
      }
      strip.show(row, clock.hours);
      shown.show(path.shown);
      kept.show(path.kept);
      said.textContent = describe(place);
      setAvailable(kept.node, place.heading != null && path.shown);
    },
    draw: () => path.draw(),
    point: (place) => path.point(place),
  };

  /** @param {string} asks @param {boolean} located */
  function whatIsMissing(asks, located) {
    if (clock.path.length) return "";
    if (clock.place) return clock.error || asks || "Waiting for the kernel …";
    if (asks) return asks;
    return located
      ? "The photo's file tells where it was taken: the clock can move the sun along its true path."
      : "Say where the photo was taken, and a clock moves the sun along its true path.";
  }

  /** @param {Place} place */
  function describe(place) {
    const sun = clock.sun();
    if (!sun) return "";
    const lifted = `Seen at ${degrees(sun.apparent)}, truly at ${degrees(sun.true)}`;
    const solar = `Solar time ${clockText(solarTime(place))}`;
    if (place.heading === null) {
      return `${lifted}. ${solar}. Without a heading the clock moves the elevation alone.`;
    }
    const way = `azimuth ${(((sun.azimuth % 360) + 360) % 360).toFixed(1)}°`;
    const aside = turned(sun.azimuth - place.heading);
    const side = `${Math.abs(aside).toFixed(1)}° ${aside < 0 ? "left" : "right"}`;
    const off = clock.follows()
      ? ""
      : " The sun was moved elsewhere: turning the clock puts it back on its path.";
    return `${lifted}, ${way} (${side}). ${solar}.${off}`;
  }
}

/** @param {string} label @param {Record<string, string | number>} attributes */
function field(label, attributes) {
  const input = element("input", { class: "sw-input", "aria-label": label, ...attributes });
  const node = element(
    "label",
    { class: "sw-place-field" },
    element("span", { class: "sw-label" }, label),
    input,
  );
  // Letters and arrows are the field's, no shortcuts.
  input.addEventListener("keydown", (event) => event.stopPropagation());
  return { node, input };
}

/** Show a value, except under a hand that writes. @param {HTMLInputElement} input @param {unknown} value */
function fill(input, value) {
  const text = String(value ?? "");
  const root = /** @type {Document | ShadowRoot} */ (input.getRootNode());
  if (input !== root.activeElement && input.value !== text) input.value = text;
}

/** What a place is but for its time. @param {Place | null} place */
const key = (place) =>
  JSON.stringify(place && [place.latitude, place.longitude, place.date, place.heading]);

/** @param {HTMLElement} node @param {boolean} on */
function setAvailable(node, on) {
  for (const control of node.querySelectorAll("button")) control.disabled = !on;
}

/** @param {string} from @param {string} to */
const days = (from, to) => (Date.parse(to) - Date.parse(from)) / 86_400_000;
const degrees = (/** @type {number} */ value) => `${value.toFixed(1).replace("-", "−")}°`;
