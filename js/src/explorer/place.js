/** Place and time: date, coordinates, and the clock that plays the day. */

import { clock, sunAt } from "../geometry/day.js";
import { degrees } from "../ui/angle_text.js";
import { element } from "../ui/element.js";
import { playButton } from "../ui/play_button.js";
import { slider } from "../ui/slider.js";

const HOURS_A_SECOND = 1; // while the day plays

/** Places with different days. @type {[string, number, number][]} */
const PLACES = [
  ["Quito", -0.18, -78.47],
  ["Prague", 50.09, 14.42],
  ["Tromsø", 69.65, 18.96],
  ["Sydney", -33.87, 151.21],
];

/**
 * @param {import("./types.js").Needs<"clamp" | "number" | "parameter" | "state" | "sun">} view
 * @param {AbortSignal} signal
 */
export function placeControls(view, signal) {
  const { state } = view;
  const date = element("input", { type: "date", class: "sw-input", "aria-label": "Date" });
  date.addEventListener("change", () => state.set({ date: date.value || null }));
  /**
   * Move to a place. A missing date defaults to today, a missing time to noon.
   *
   * @param {Record<string, number | null>} changes
   */
  const move = (changes) => {
    const { latitude, longitude, date: day, time: hours } = { ...state.values, ...changes };
    const complete = latitude !== null && longitude !== null;
    state.set({
      ...changes,
      ...(complete && { date: day ?? new Date().toISOString().slice(0, 10), time: hours ?? 12 }),
    });
  };
  const numbers = ["latitude", "longitude"].map((name) => {
    const p = view.parameter(name);
    const input = element("input", {
      type: "number",
      class: "sw-input",
      "aria-label": `${p.label} in degrees`,
      min: p.minimum,
      max: p.maximum,
      step: "any",
      title: p.help,
    });
    input.addEventListener("change", () => {
      const value = input.value === "" ? null : view.clamp(name, Number(input.value));
      move({ [name]: value });
    });
    return { name, label: p.label, input };
  });
  const field = (/** @type {string} */ label, /** @type {HTMLElement} */ input) =>
    element(
      "label",
      { class: "sw-named-field" },
      element("span", { class: "sw-label" }, label),
      input,
    );
  const fields = element(
    "div",
    { class: "sw-place" },
    field("Date", date),
    ...numbers.map(({ label, input }) => field(label, input)),
  );

  const chips = PLACES.map(([name, latitude, longitude]) => {
    const chip = element("button", { type: "button", class: "sw-chip" }, name);
    chip.addEventListener("click", () => move({ latitude, longitude }));
    return chip;
  });

  const time = slider({
    parameter: /** @type {any} */ ({
      ...view.parameter("time"),
      default: undefined,
      step: 0.05,
      unit: "h",
      label: "Time, UTC",
    }),
    onBegin: () => state.begin(),
    onInput: (value) => view.sun.moveTime(Number(value)),
    onCommit: () => state.commit(),
  });
  const play = playButton(
    {
      label: "Play the day",
      title: "Play the day, one hour per second",
      onStep: (seconds) => {
        // Another gesture ends this history step; playback continues in the next.
        state.begin();
        view.sun.moveTime((view.number("time") + seconds * HOURS_A_SECOND) % 24);
        return true;
      },
      onStop: () => state.commit(),
    },
    signal,
  );
  const hint = element("p", { class: "sw-hint" });
  const row = element("div", { class: "sw-time" }, play.node, time.node);

  return {
    nodes: [element("div", { class: "sw-chips" }, ...chips), fields, row, hint],
    show() {
      const { values } = state;
      if (!date.matches(":focus")) date.value = String(values.date ?? "");
      for (const { name, input } of numbers) {
        if (!input.matches(":focus")) input.value = String(values[name] ?? "");
      }
      const day = view.sun.day();
      row.hidden = day.length === 0;
      if (!day.length) {
        play.stop();
        hint.textContent = "Set a date and a place, and the clock moves the sun along its path.";
        return;
      }
      const hours = /** @type {number | null} */ (values.time);
      time.show(hours, 12);
      const sun = hours === null ? null : sunAt(day, hours);
      hint.textContent = sun
        ? `${clock(Number(hours))} UTC: sun azimuth ${degrees(sun.azimuth)}, apparent elevation ${degrees(sun.apparent)}, ` +
          `true ${degrees(sun.true)}.`
        : "The clock is paused: the sun was moved by hand. Moving the clock puts it back on its path.";
    },
  };
}
