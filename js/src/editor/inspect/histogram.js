/**
 * The canvas's histogram: red, green, blue and luminance, the photo's luminance as a line, and a
 * clipping mark at each end.
 */

import { Fence } from "../../gl/fence.js";
import { whenIdle } from "../../host/idle.js";
import { element, setAttributes, shape } from "../../ui/element.js";
import { countedSection } from "../../ui/section.js";
import { ceiling, countLevels, hill } from "./levels.js";

/** @typedef {import("./levels.js").Levels} Levels */

const EDGE = 256; // longer side of the copy that is counted, pixels
const EVERY_MS = 150;
// Reading the canvas waits for the current frame. If that is slow, the canvas is read only at rest.
const SLOW_MS = 6;
const REST_MS = 600;
const PAUSE_MS = 60;
const COST_DECAY = 0.7; // per reading
const WIDTH = 240;
const HEIGHT = 56;
const CHANNELS = /** @type {const} */ (["red", "green", "blue"]);
// Shown until there is a picture to count.
const UNKNOWN = { role: "img", "aria-label": "Not counted yet" };
const CLIPPED_FROM = 0.001; // share of the picture from which clipping is reported

/** @type {import("../types.js").MakePart<"drawing" | "panel" | "stage" | "state">} */
export function histogram({ drawing, panel, stage, state }, signal) {
  const hills = CHANNELS.map((name) => shape("path", { class: `sw-levels-${name}` }));
  const luminance = shape("path", { class: "sw-levels-luminance" });
  const before = shape("path", { class: "sw-levels-before" });
  const svg = shape(
    "svg",
    {
      class: "sw-levels",
      viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
      preserveAspectRatio: "none",
      ...UNKNOWN,
    },
    ...hills,
    luminance,
    before,
  );
  const marks = {
    black: element("span", { class: "sw-clipped sw-clipped-black", ...UNKNOWN }),
    white: element("span", { class: "sw-clipped sw-clipped-white", ...UNKNOWN }),
  };
  const { node, head, body } = countedSection(
    {
      title: "Histogram",
      open: panel.isOpen("histogram"),
      onFold: (open) => {
        panel.keepFold("histogram", open);
        wake();
      },
    },
    element("div", { class: "sw-levels-box" }, svg, marks.black, marks.white),
  );
  const text = element("span", {
    class: "sw-levels-text",
    title: "How much of the picture is clipped",
  });
  head.append(text);
  panel.top.append(node);

  const small = document.createElement("canvas");
  const context = small.getContext("2d", { willReadFrequently: true });
  /** @type {Levels | null} */
  let own = null; // the photo's levels
  let counted = 0; // time of the last count, ms
  let cost = 0; // recent time to read the canvas, ms
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let timer;
  let forget = () => {};
  const fence = new Fence(drawing.frame);

  /** @param {HTMLCanvasElement | HTMLImageElement} source @returns {Levels | null} */
  const read = (source) => {
    const [width, height] =
      source instanceof HTMLImageElement
        ? [source.naturalWidth, source.naturalHeight]
        : [source.width, source.height];
    if (!context || !width || !height) return null;
    const scale = Math.min(1, EDGE / Math.max(width, height));
    small.width = Math.max(1, Math.round(width * scale));
    small.height = Math.max(1, Math.round(height * scale));
    // Averaging would hide clipping, so pixels are picked.
    context.imageSmoothingEnabled = false;
    context.drawImage(source, 0, 0, small.width, small.height);
    return countLevels(context.getImageData(0, 0, small.width, small.height).data);
  };

  const show = () => {
    if (state.before !== null && cost > SLOW_MS) return; // the gesture's end draws again
    if (!fence.passed()) {
      clearTimeout(timer);
      timer = setTimeout(idle, PAUSE_MS);
      return;
    }
    own ??= read(stage.photo);
    counted = performance.now();
    // Until there is a frame, the photo is shown.
    const now = drawing.live ? read(stage.canvas) : own;
    cost = Math.max(performance.now() - counted, COST_DECAY * cost);
    if (!now) return;
    const most = ceiling([now.red, now.green, now.blue, now.luminance]);
    CHANNELS.forEach((name, i) => {
      setAttributes(hills[i], { d: hill(now[name], most, WIDTH, HEIGHT) });
    });
    setAttributes(luminance, { d: hill(now.luminance, most, WIDTH, HEIGHT) });
    setAttributes(before, { d: own ? hill(own.luminance, most, WIDTH, HEIGHT) : "" });
    const texts = /** @type {const} */ (["black", "white"]).map((end) => {
      const share = now.clipped[end];
      const word = end === "black" ? "Blacks" : "Highlights";
      const was = own ? `, in the photo ${percent(own.clipped[end])}` : "";
      const label = `${word} clipped: ${percent(share)}${was}`;
      setAttributes(marks[end], { "aria-label": label, title: label });
      marks[end].classList.toggle("sw-on", share > CLIPPED_FROM);
      return share > CLIPPED_FROM ? `${percent(share)} ${end}` : "";
    });
    text.textContent = texts.filter(Boolean).join(", ");
    svg.setAttribute("aria-label", `Histogram. ${text.textContent || "Nothing is clipped"}.`);
  };
  const idle = () => {
    timer = undefined;
    forget();
    forget = whenIdle(show);
  };
  const wake = () => {
    const slow = cost > SLOW_MS;
    if (body.hidden || signal.aborted || (timer && !slow)) return;
    clearTimeout(timer);
    timer = setTimeout(idle, slow ? REST_MS : Math.max(0, counted + EVERY_MS - performance.now()));
  };
  signal.addEventListener("abort", () => {
    clearTimeout(timer);
    forget();
  });
  stage.photo.addEventListener("load", () => {
    own = null;
    wake();
  });
  return { drawn: wake };
}

/** @param {number} share */
const percent = (share) => {
  const value = 100 * share;
  return `${value === 0 || value >= 10 ? Math.round(value) : value.toFixed(1)} %`;
};
