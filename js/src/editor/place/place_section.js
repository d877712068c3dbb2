/** The "Time and place" part of the sun section: clock, fields and the photo's metadata. */

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
    heading.say((clock.photoPlace.notes ?? []).join(" "));
  });
  const photoTime = chip("Photo's time", "Set the clock to when the photo was taken", () => {
    const { date, time } = clock.photoPlace;
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

  const onTrait = () => parts.show();
  for (const name of TRAITS) model.on(`change:${name}`, onTrait);
  signal.addEventListener("abort", () => {
    for (const name of TRAITS) model.off(`change:${name}`, onTrait);
  });

  /** @param {string} reason why the kernel cannot compute a path, or "" @param {boolean} located */
  const describeMissing = (reason, located) => {
    if (clock.path.length) return "";
    if (clock.place) return clock.error || reason || "Waiting for the kernel …";
    if (reason) return reason;
    return located
      ? "The photo's file records where it was taken, so a clock can move the sun along its true path."
      : "Enter where the photo was taken, and a clock moves the sun along its true path.";
  };

  return {
    show() {
      const { place, photoPlace } = clock;
      const reason = kernel.answers ? "" : "Needs the kernel, which computes the day's path";
      const located = photoPlace.latitude != null && photoPlace.longitude != null;
      fields.show(reason);
      heading.show();
      day.show();
      fromPhoto.hidden = !located;
      fromPhoto.disabled = reason !== "";
      fromPhoto.classList.toggle("sw-primary", place === null);
      photoTime.hidden = photoPlace.time == null || place === null;
      missing.textContent = describeMissing(reason, located);
      missing.hidden = missing.textContent === "";
    },
    draw: () => path.draw(),
    point: (place) => path.point(place),
  };
}
