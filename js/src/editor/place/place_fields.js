/** Input fields for latitude, longitude, date, time and heading. */

import { clock as clockText } from "../../geometry/day.js";
import { inputField } from "../../ui/named_field.js";

const TIME = /^\s*(\d{1,2})(?:[:.h ]?([0-5]\d))?\s*$/;

/** @param {import("../types.js").Needs<"clock" | "parts" | "state">} needs */
export function placeFields({ clock, parts, state }) {
  const coordinates = [
    { name: "latitude", limit: 90, title: "Degrees, positive to the north" },
    { name: "longitude", limit: 180, title: "Degrees, positive to the east" },
  ].map(({ name, limit, title }) => {
    const bounds = { min: -limit, max: limit, step: "any" };
    const label = name[0].toUpperCase() + name.slice(1);
    const made = inputField(label, { type: "number", placeholder: "°", title, ...bounds });
    return { name: /** @type {"latitude" | "longitude"} */ (name), title, ...made };
  });
  const date = inputField("Date, UTC", { type: "date" });
  const time = inputField("Time, UTC", {
    type: "text",
    inputmode: "numeric",
    autocomplete: "off",
    spellcheck: "false",
    title: "Hours and minutes in UTC, such as 17:30",
  });
  const heading = inputField("Heading", {
    type: "number",
    min: 0,
    max: 360,
    step: "any",
    placeholder: "unknown",
    title: "Direction of the camera, degrees clockwise from true north",
  });

  const onCoordinate = () => {
    const inputs = coordinates.map(({ input }) => input);
    if (!inputs.every((input) => input.reportValidity())) return;
    const [latitude, longitude] = inputs.map(({ value }) => (value === "" ? null : Number(value)));
    if (latitude === null && longitude === null) state.set({ place: null });
    else if (latitude === null || longitude === null) return;
    else if (clock.place) clock.setPlace({ latitude, longitude });
    else clock.take(latitude, longitude);
  };
  for (const { input } of coordinates) input.addEventListener("change", onCoordinate);
  date.input.addEventListener("change", () => {
    if (date.input.value) clock.setPlace({ date: date.input.value });
  });
  time.input.addEventListener("change", () => {
    const [, hours, minutes = "0"] = TIME.exec(time.input.value) ?? [];
    const value = Number(hours) + Number(minutes) / 60;
    if (clock.place && value <= 24) clock.moveToMoment(clock.place.date, value);
    parts.show();
  });
  heading.input.addEventListener("change", () => {
    const { value } = heading.input;
    if (!heading.input.reportValidity()) return;
    clock.setPlace({ heading: value === "" ? null : Number(value) % 360 });
  });

  return {
    nodes: [...coordinates, date, time, heading].map(({ node }) => node),
    /** @param {string} reason why the path of another day is unavailable, or "" */
    show(reason) {
      const { place } = clock;
      for (const { name, input, title } of coordinates) {
        fill(input, place?.[name]);
        input.disabled = reason !== "";
        input.title = reason || title;
      }
      fill(date.input, place?.date);
      fill(time.input, place ? clockText(place.time) : null);
      fill(heading.input, place?.heading == null ? null : Number(place.heading.toFixed(1)));
      date.input.disabled = !place || reason !== "";
      date.input.title = reason || "Day in UTC";
      time.input.disabled = heading.input.disabled = !place;
    },
  };
}

/** Show a value, unless the user is typing in the field. @param {HTMLInputElement} input @param {unknown} value */
function fill(input, value) {
  const text = String(value ?? "");
  const root = /** @type {Document | ShadowRoot} */ (input.getRootNode());
  if (input !== root.activeElement && input.value !== text) input.value = text;
}
