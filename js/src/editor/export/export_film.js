/** The export panel's film page: the path, playback and file options. */

import { EASINGS, keyFramePath } from "../../film/film_path.js";
import { clock as clockText } from "../../geometry/day.js";
import { editAt } from "../../geometry/place.js";
import { element } from "../../ui/element.js";
import { inputField, selectField } from "../../ui/named_field.js";
import { exportTarget, formatOptions, lacking } from "./export_target.js";
import { filmPlayer } from "./film_player.js";
import { keyFrames } from "./key_frames.js";

const TWILIGHT = -6; // degrees of the sun where the film of a day begins and ends
const TIME = /^\s*(\d{1,2})(?:[:.h ]?([0-5]\d))?\s*$/;
const DAY = 24; // hours
/** @type {[string, string][]} */
const EASING_NAMES = [
  ["linear", "Even"],
  ["ease_in_out", "Slow at both ends"],
  ["ease_in", "Slow start"],
  ["ease_out", "Slow end"],
  ["smooth", "Smooth throughout"],
];

/**
 * @param {Parameters<typeof keyFrames>[0] & Parameters<typeof filmPlayer>[0]
 *   & import("../types.js").Needs<"clock" | "kernel">} needs
 * @param {import("./export_job.js").Job} job
 * @param {AbortSignal} signal
 */
export function exportFilm({ clock, kernel, ...needs }, job, signal) {
  const { picture, state } = needs;
  const keys = keyFrames(needs);
  /** @type {import("./export_target.js").Choices | null} */
  let choices = null;
  /** @type {[number, number] | null} first and last hour of a film of the day, once set by hand */
  let hours = null;

  const way = selectField("Path", [
    ["keys", "Key frames"],
    ["day", "The day"],
  ]);
  const [from, to] = ["From, UTC", "To, UTC"].map((label) =>
    inputField(label, { type: "text", inputmode: "numeric", autocomplete: "off" }),
  );
  const length = inputField("Seconds", { type: "number", min: 0.5, max: 600, step: "any" });
  length.input.value = "5";
  const easing = selectField(
    "Speed",
    EASING_NAMES.filter(([name]) => name in EASINGS),
  );
  const loop = selectField("Repeat", [
    ["forever", "Forever"],
    ["there_and_back", "There and back"],
    ["once", "Once"],
  ]);
  const format = selectField("Format");
  const fps = selectField(
    "Frame rate",
    [24, 25, 30, 60, 12].map((rate) => [String(rate), String(rate)]),
  );
  const size = selectField("Longer side");
  const quality = inputField("Quality", { type: "number", min: 1, max: 100, value: 85 });
  const why = element("p", { class: "sw-hint" });

  const byDay = () => way.select.value === "day";
  const span = () => hours ?? daylight(clock.path);
  /** The key frames; with fewer than two, the photo or the one key frame, then the edit. @returns {import("../../film/film_path.js").KeyFrame[]} */
  const stations = () => {
    const frames = keys.read();
    if (frames.length > 1) return frames;
    const end = { seconds: Number(length.input.value), recipe: state.recipe() };
    return [{ recipe: frames[0]?.recipe ?? {}, seconds: 0 }, end];
  };
  /** Return why no film can be made, or "". */
  const still = () => {
    if (!picture.scene) return "The photo has not been analyzed yet.";
    if (byDay()) {
      if (!clock.place || !clock.path.length) return "Set a place and time first: Time and place.";
      return clock.place.heading === null ? "Set the camera's heading first: Time and place." : "";
    }
    if (keys.read().length > 1) return "";
    const [start, end] = [0, 1].map((share) => JSON.stringify(pathOf(stations())(share)));
    return start === end ? "Nothing moves yet: move the sun, or add key frames." : "";
  };
  const pathOf = (/** @type {import("../../film/film_path.js").KeyFrame[]} */ frames) =>
    keyFramePath(
      frames,
      easing.select.value,
      state.parameters,
      state.values,
      picture.scene?.automatic ?? {},
    );

  /** @type {{ on: string, film: import("./film_player.js").Film } | null} */
  let known = null;
  const film = () => {
    if (still()) return null;
    const settings = [way, easing, loop].map(({ select }) => select.value);
    const moves = [keys.read(), state.recipe(), span()];
    const on = JSON.stringify([settings, length.input.value, moves]);
    if (known?.on !== on) known = { on, film: makeFilm() };
    return known.film;
  };
  const makeFilm = () => {
    const seconds = lengthOf();
    if (!byDay()) return { path: pathOf(stations()), seconds, loop: loop.select.value };
    const { place, path } = clock;
    const [first, last] = span();
    const ease = EASINGS[easing.select.value];
    const edit = { ...state.values };
    return {
      path: (/** @type {number} */ share) => ({
        ...edit,
        ...(place ? editAt(place, path, first + (last - first) * ease(share)) : {}),
      }),
      seconds,
      loop: loop.select.value,
    };
  };
  const lengthOf = () => {
    const frames = keys.read();
    if (!byDay() && frames.length > 1) return frames[frames.length - 1].seconds;
    return Math.max(0.5, Number(length.input.value) || 5);
  };
  const player = filmPlayer(needs, signal, film);

  const target = exportTarget("film", () => {
    if (![length, quality].every(({ node, input }) => node.hidden || input.reportValidity())) {
      return;
    }
    const own = !byDay() && keys.read().length > 1;
    const content = {
      ...target.content(),
      suffix: format.select.value,
      fps: Number(fps.select.value),
      easing: easing.select.value,
      loop: loop.select.value,
      seconds: own ? null : lengthOf(),
      quality: Number(quality.input.value),
      long_edge: Number(size.select.value) || null,
      hours: byDay() ? span() : null,
    };
    player.stop();
    void job.run("film", content, (name) => target.rename(name));
  });

  length.input.addEventListener("change", () => {
    const seconds = Number(length.input.value);
    const frames = keys.read();
    if (!length.input.checkValidity() || !seconds) length.input.value = String(lengthOf());
    else if (!byDay() && frames.length > 1) {
      const share = seconds / frames[frames.length - 1].seconds;
      keys.write(frames.map((frame) => ({ ...frame, seconds: frame.seconds * share })));
    }
    show();
  });
  for (const [i, { input }] of [from, to].entries()) {
    input.addEventListener("change", () => {
      const at = tableHours(clock.path, input.value);
      const [first, last] = span();
      const wanted = /** @type {[number, number]} */ (i ? [first, at] : [at, last]);
      if (Number.isFinite(at) && wanted[0] < wanted[1]) hours = wanted;
      show();
    });
  }
  for (const { select } of [way, easing, loop, format]) {
    select.addEventListener("change", () => {
      player.stop();
      show();
    });
  }

  const node = element(
    "div",
    { class: "sw-export-page" },
    keys.node,
    player.node,
    element(
      "div",
      { class: "sw-export-fields" },
      ...[way, from, to, length, easing, loop, format, fps, size, quality].map(
        (field) => field.node,
      ),
    ),
    why,
    target.node,
    target.hint,
  );

  const show = () => {
    const day = byDay();
    keys.node.hidden = day;
    if (!day) keys.show();
    const [first, last] = span();
    for (const [i, { node: field, input }] of [from, to].entries()) {
      field.hidden = !day || !clock.path.length;
      input.value = clockText((((i ? last : first) % DAY) + DAY) % DAY);
    }
    if (!length.input.matches(":focus")) length.input.value = String(lengthOf());
    const reason = still();
    why.textContent = reason;
    why.hidden = reason === "";
    const kind = choices?.films.find(({ suffix }) => suffix === format.select.value);
    const asks = kernel.answers ? lacking(kind) : "Needs the kernel: run the cell again.";
    quality.node.hidden = !kind?.quality;
    target.show(kind?.suffix === ".png" ? "" : (kind?.suffix ?? ""), asks || reason);
    target.hint.hidden = asks === "";
    player.show();
  };

  return {
    node,
    show,
    stop: () => player.stop(),
    drawn: () => keys.drawn(),
    loaded() {
      keys.loaded();
      hours = known = null;
    },
    /** @param {import("./export_target.js").Choices} found */
    take(found) {
      choices = found;
      format.setOptions(formatOptions(found.films));
      const longest = Math.max(...found.size);
      const sides = [3840, 1920, 1280, 960, 640].filter((side) => side <= longest);
      size.setOptions([
        ["", "Automatic"],
        ...sides.map((side) => /** @type {[string, string]} */ ([String(side), `${side} pixels`])),
      ]);
      target.take(found);
      show();
    },
  };
}

/** Civil dawn and civil dusk in the path's hours. @param {import("../../geometry/day.js").DayRow[]} path @returns {[number, number]} */
function daylight(path) {
  const up = path.filter(([, , apparent]) => apparent > TWILIGHT).map(([hour]) => hour);
  if (up.length) return [up[0], up[up.length - 1]];
  return path.length ? [path[0][0], path[path.length - 1][0]] : [0, DAY];
}

/** Convert a clock time to the path's hours; NaN if it is not a time. @param {import("../../geometry/day.js").DayRow[]} path @param {string} text */
function tableHours(path, text) {
  const [, whole, minutes = "0"] = TIME.exec(text) ?? [];
  const at = Number(whole) + Number(minutes) / 60;
  if (!path.length || !(at <= DAY)) return Number.NaN;
  const first = path[0][0];
  return first + ((((at - first) % DAY) + DAY) % DAY);
}
