/** The day strip with its clock, playback, and a description of the sun at that time. */

import { clock as clockText, sunAt, turned } from "../../geometry/day.js";
import { solarTime } from "../../geometry/place.js";
import { aside, degrees } from "../../ui/angle_text.js";
import { element } from "../../ui/element.js";
import { playButton } from "../../ui/play_button.js";
import { toggle } from "../../ui/toggle.js";
import { dayStrip } from "./day_strip.js";

/** @typedef {import("../../geometry/place.js").Place} Place */

const HOURS_A_SECOND = 1; // while the day plays
const NIGHT = -12; // degrees below which nothing changes

/**
 * @param {import("../types.js").Needs<"clock" | "hand" | "parts" | "state"> & {
 *   path: import("./sun_path.js").SunPath,
 * }} needs
 * @param {AbortSignal} signal
 */
export function dayControls({ clock, hand, parts, path, state }, signal) {
  const strip = dayStrip({
    onBegin: () => state.begin(),
    onInput: (hours) => clock.moveTo(hours),
    onCommit: () => state.commit(),
  });
  const play = playButton(
    {
      label: "Play the day",
      title: "Play the day, one hour per second; the night is skipped",
      onStep: (seconds) => {
        // A drag on the picture takes precedence.
        if (hand.pointer !== null) return false;
        // Another gesture ends this history step; playback continues in the next.
        state.begin();
        clock.moveTo(skipNight(clock.hours + seconds * HOURS_A_SECOND));
        return true;
      },
      onStop: () => state.commit(),
    },
    signal,
  );
  const said = element("p", { class: "sw-hint" });
  /** @type {(label: string, help: string, on: boolean, onChange: (on: boolean) => void) => ReturnType<typeof toggle>} */
  const choice = (label, help, on, onChange) =>
    toggle({
      parameter: { name: "", label, help, default: on },
      onChange: (now) => {
        onChange(now);
        parts.show();
      },
    });
  const shown = choice(
    "Path on the picture",
    "The sun's path over the day, with hours in UTC. Drag along it to set the clock.",
    true,
    (on) => {
      path.shown = on;
    },
  );
  const kept = choice(
    "Keep the sun on the path",
    "Dragging the sun, or its arrow keys, then sets the clock",
    false,
    (on) => {
      path.kept = on;
    },
  );
  const node = element(
    "div",
    { class: "sw-day" },
    element("div", { class: "sw-day-row" }, play.node, strip.node),
    said,
    shown.node,
    kept.node,
  );

  /** Return the hour, or the end of the night if it falls in one. @param {number} hours */
  const skipNight = (hours) => {
    const row = clock.path;
    const [first, end] = [row[0][0], row[row.length - 1][0]];
    const at = hours >= end ? first : hours;
    const sun = sunAt(row, at);
    if (!sun || sun.apparent > NIGHT) return at;
    const lit = row.filter(([, , up]) => up > NIGHT).map(([hour]) => hour);
    return lit.find((hour) => hour > at) ?? lit[0] ?? at;
  };
  /** @param {Place} place */
  const describe = (place) => {
    const sun = clock.sun();
    if (!sun) return "";
    const lifted = `Apparent elevation ${degrees(sun.apparent)}, true ${degrees(sun.true)}`;
    const solar = `Solar time ${clockText(solarTime(place))}`;
    if (place.heading === null) {
      return `${lifted}. ${solar}. Without a heading, the clock changes only the elevation.`;
    }
    const north = (((sun.azimuth % 360) + 360) % 360).toFixed(1);
    const off = clock.follows()
      ? ""
      : " The sun was moved off its path: setting the clock puts it back.";
    return `${lifted}, azimuth ${north}° (${aside(turned(sun.azimuth - place.heading))}). ${solar}.${off}`;
  };

  return {
    node,
    show() {
      const { place } = clock;
      const row = clock.path;
      node.hidden = !place || !row.length;
      if (!place || !row.length) return play.stop();
      strip.show(row, clock.hours);
      shown.show(path.shown);
      kept.show(path.kept);
      said.textContent = describe(place);
      for (const control of [shown, kept]) {
        const idle = place.heading === null || (control === kept && !path.shown);
        for (const one of control.node.querySelectorAll("button")) one.disabled = idle;
      }
    },
  };
}
