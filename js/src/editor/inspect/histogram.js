/**
 * The histogram of what is on the canvas: red, green, blue and luminance, the photo's own
 * luminance as a line, and a mark at each end where detail is lost.
 */

import { Fence } from "../../gl/fence.js";
import { whenIdle } from "../../host/idle.js";
import { element, setAttributes, shape } from "../../ui/element.js";
import { countedSection } from "../../ui/section.js";
import { ceiling, countLevels, hill } from "./levels.js";

/** @typedef {import("./levels.js").Levels} Levels */

const EDGE = 256; // pixels of the longer side that are counted
const EVERY_MS = 150;
// Reading the canvas waits for the frame under way. Where that takes long, it is read at rest.
const DEAR_MS = 6;
const RESTED_MS = 600;
const PAUSE_MS = 60;
const FORGETS = 0.7; // of the cost, with each reading
const WIDTH = 240;
const HEIGHT = 56;
const CHANNELS = /** @type {const} */ (["red", "green", "blue"]);
// Until there is a picture to count.
const UNKNOWN = { role: "img", "aria-label": "Not counted yet" };
const WORTH_SAYING = 0.001; // share of the picture that is clipped

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
  let own = null; // of the photo
  let counted = 0; // when, ms
  let cost = 0; // of reading, ms
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
    // Averages would hide what is clipped: pixels are picked.
    context.imageSmoothingEnabled = false;
    context.drawImage(source, 0, 0, small.width, small.height);
    return countLevels(context.getImageData(0, 0, small.width, small.height).data);
  };

  const show = () => {
    if (state.before !== null && cost > DEAR_MS) return; // its end draws again
    if (!fence.passed()) {
      clearTimeout(timer);
      timer = setTimeout(idle, PAUSE_MS);
      return;
    }
    own ??= read(stage.photo);
    counted = performance.now();
    // Until there is a frame, the photo stands where it will be.
    const now = drawing.live ? read(stage.canvas) : own;
    cost = Math.max(performance.now() - counted, FORGETS * cost);
    if (!now) return;
    const most = ceiling([now.red, now.green, now.blue, now.luminance]);
    CHANNELS.forEach((name, i) => {
      setAttributes(hills[i], { d: hill(now[name], most, WIDTH, HEIGHT) });
    });
    setAttributes(luminance, { d: hill(now.luminance, most, WIDTH, HEIGHT) });
    setAttributes(before, { d: own ? hill(own.luminance, most, WIDTH, HEIGHT) : "" });
    const said = /** @type {const} */ (["black", "white"]).map((end) => {
      const share = now.clipped[end];
      const word = end === "black" ? "Blacks" : "Highlights";
      const was = own ? `, in the photo ${percent(own.clipped[end])}` : "";
      const label = `${word} clipped: ${percent(share)}${was}`;
      setAttributes(marks[end], { "aria-label": label, title: label });
      marks[end].classList.toggle("sw-on", share > WORTH_SAYING);
      return share > WORTH_SAYING ? `${word} ${percent(share)}` : "";
    });
    text.textContent = said.filter(Boolean).join(" · ");
    svg.setAttribute("aria-label", `Histogram. ${text.textContent || "Nothing is clipped"}.`);
  };
  const idle = () => {
    timer = undefined;
    forget();
    forget = whenIdle(show);
  };
  const wake = () => {
    const dear = cost > DEAR_MS;
    if (body.hidden || signal.aborted || (timer && !dear)) return;
    clearTimeout(timer);
    timer = setTimeout(
      idle,
      dear ? RESTED_MS : Math.max(0, counted + EVERY_MS - performance.now()),
    );
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
