/** Time and place, in the section of the sun: the clock, the fields and the photo's own file. */

import { chip } from "../../ui/chips.js";
import { element } from "../../ui/element.js";
import { section } from "../../ui/section.js";
import { dayControls } from "./day_controls.js";
import { headingMatch } from "./heading_match.js";
import { placeFields } from "./place_fields.js";
import { SunPath } from "./sun_path.js";

const TRAITS = ["_day", "_photo_place"];

/**
 * @type {import("../types.js").MakePart<"clock" | "hand" | "kernel" | "model" | "panel" | "parts"
 *   | "picture" | "stage" | "state">}
 */
export function placeSection(
  { clock, hand, kernel, model, panel, parts, picture, stage, state },
  signal,
) {
  const path = new SunPath({ clock, hand, model, picture, stage });
  /** @type {import("../../ui/sun_tool.js").SunTool} */ (hand.tools.sun).track = path;

  const day = dayControls({ clock, hand, parts, path, state }, signal);
  const fields = placeFields({ clock, parts, state });
  const heading = headingMatch({ clock, picture, state });
  const fromPhoto = chip("From the photo", "Place, time and heading from the photo's file", () => {
    clock.takeFromFile();
    heading.say((clock.told.notes ?? []).join(" "));
  });
  const photoTime = chip("Photo's time", "Set the clock to when the photo was taken", () => {
    const { date, time } = clock.told;
    if (date != null && time != null) clock.moveToMoment(date, time);
  });
  const missing = element("p", { class: "sw-hint", hidden: true });
  const node = section(
    { title: "Time and place", open: clock.place !== null, className: "sw-more sw-clock" },
    day.node,
    element("div", { class: "sw-clock-place" }, ...fields.nodes, heading.button),
    element("div", { class: "sw-chips sw-place-chips" }, fromPhoto, photoTime),
    missing,
    ...heading.nodes,
  );
  panel.section("sun").append(node);

  const arrived = () => parts.show();
  for (const name of TRAITS) model.on(`change:${name}`, arrived);
  signal.addEventListener("abort", () => {
    for (const name of TRAITS) model.off(`change:${name}`, arrived);
  });

  /** @param {string} asks @param {boolean} located */
  const whatIsMissing = (asks, located) => {
    if (clock.path.length) return "";
    if (clock.place) return clock.error || asks || "Waiting for the kernel …";
    if (asks) return asks;
    return located
      ? "The photo's file records where it was taken, so a clock can move the sun along its true path."
      : "Enter where the photo was taken, and a clock moves the sun along its true path.";
  };

  return {
    show() {
      const { place, told } = clock;
      const asks = kernel.answers ? "" : "Needs the kernel, which computes the day's path";
      const located = told.latitude != null && told.longitude != null;
      fields.show(asks);
      heading.show();
      day.show();
      fromPhoto.hidden = !located;
      fromPhoto.disabled = asks !== "";
      fromPhoto.classList.toggle("sw-primary", place === null);
      photoTime.hidden = told.time == null || place === null;
      missing.textContent = whatIsMissing(asks, located);
      missing.hidden = missing.textContent === "";
    },
    draw: () => path.draw(),
    point: (place) => path.point(place),
  };
}
