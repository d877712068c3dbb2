/** The day as a strip of sky colors from one solar midnight to the next, with the clock on it. */

import { clock as clockText, sunAt } from "../../geometry/day.js";
import { element, setAttributes } from "../../ui/element.js";

/** @typedef {import("../../geometry/day.js").DayRow} DayRow */

const STOPS = 48;
/** Colors by the sun's elevation in degrees. @type {[number, string][]} */
const LIGHT = [
  [-14, "--sw-day-night"],
  [-5, "--sw-day-dusk"],
  [1, "--sw-day-low"],
  [14, "--sw-day-high"],
];

/**
 * @param {{ onBegin: () => void, onInput: (hours: number) => void, onCommit: () => void }} options
 */
export function dayStrip({ onBegin, onInput, onCommit }) {
  const range = element("input", {
    type: "range",
    class: "sw-day-range",
    step: 1 / 60,
    "aria-label": "Time of day, UTC",
    title: "Time of day: moves the sun along its path",
  });
  const node = element("div", { class: "sw-day-strip" }, range);
  range.addEventListener("input", () => {
    onBegin();
    onInput(Number(range.value));
  });
  range.addEventListener("change", onCommit);
  range.addEventListener("keydown", (event) => {
    // One minute per key is too slow: use five, or an hour with Shift.
    const direction = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
    if (!direction) return;
    event.preventDefault();
    event.stopPropagation();
    onBegin();
    onInput(Number(range.value) + (direction * (event.shiftKey ? 60 : 5)) / 60);
  });
  range.addEventListener("keyup", onCommit);
  range.addEventListener("blur", onCommit);
  /** @type {DayRow[] | null} */
  let drawn = null;
  return {
    node,
    /** @param {DayRow[]} path @param {number} hours */
    show(path, hours) {
      const [first, last] = [path[0][0], path[path.length - 1][0]];
      if (path !== drawn) {
        drawn = path;
        setAttributes(range, { min: first, max: last });
        node.style.background = gradient(path);
      }
      range.value = String(hours);
      const sun = sunAt(path, hours);
      setAttributes(range, {
        "aria-valuetext": `${clockText(((hours % 24) + 24) % 24)} UTC, sun at ${sun?.apparent.toFixed(1)}°`,
      });
    },
  };
}

/** @param {DayRow[]} path */
function gradient(path) {
  const [first, last] = [path[0][0], path[path.length - 1][0]];
  const stops = Array.from({ length: STOPS + 1 }, (_, i) => {
    const sun = sunAt(path, first + ((last - first) * i) / STOPS);
    return `${color(sun?.apparent ?? -90)} ${((100 * i) / STOPS).toFixed(1)}%`;
  });
  return `linear-gradient(to right, ${stops.join(", ")})`;
}

/** @param {number} up degrees */
function color(up) {
  const after = LIGHT.findIndex(([level]) => level > up);
  if (after === 0) return `var(${LIGHT[0][1]})`;
  if (after < 0) return `var(${LIGHT[LIGHT.length - 1][1]})`;
  const [[low, from], [high, to]] = [LIGHT[after - 1], LIGHT[after]];
  const share = Math.round((100 * (up - low)) / (high - low));
  return `color-mix(in oklab, var(${to}) ${share}%, var(${from}))`;
}
