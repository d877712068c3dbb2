/**
 * The presets, each with a small picture of what it makes of this photo. They are drawn one by
 * one while the page has nothing else to do, never while a hand is on the picture.
 */

import { presetChips } from "../controls/chips.js";
import { element } from "../controls/element.js";
import { Fence } from "../gl/fence.js";
import { Sketch } from "../gl/sketch.js";
import { whenIdle } from "../idle.js";

/** @typedef {import("../controls/chips.js").Preset} Preset */

const AREA = 76_000; // pixels of a frame; nine make one of the thumbnail
const SHRINK = 3;
const DENSE = 2; // device pixels to a CSS pixel that the thumbnails are made for
const QUIET_MS = 400; // after the last change
const PAUSE_MS = 60; // between two of them
const PLACES = 6;
const WIDTH = 150; // of the photo in a thumbnail's place, pixels

/** @type {import("./parts.js").MakePart} */
export function presetThumbnails(view, signal) {
  const sketch = new Sketch(view.frame);
  const fence = new Fence(view.frame);
  /** @type {{ preset: Preset, canvas: HTMLCanvasElement, key: string }[]} */
  let all = [];
  let generation = 0; // of the scene
  let inSight = false;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let timer;
  let forget = () => {};

  /** What stands there until the thumbnail is drawn. @param {HTMLCanvasElement} canvas */
  const placePhoto = (canvas) => {
    const { photo } = view.stage;
    if (!photo.naturalWidth) return;
    canvas.width = WIDTH;
    canvas.height = Math.round((WIDTH * photo.naturalHeight) / photo.naturalWidth);
    canvas.getContext("2d")?.drawImage(photo, 0, 0, canvas.width, canvas.height);
  };
  const chips = presetChips(
    view.state,
    () => view.scene?.presets ?? [],
    (preset) => {
      const canvas = element("canvas", { class: "sw-thumbnail", "aria-hidden": "true" });
      placePhoto(canvas);
      all = all.filter((one) => one.preset.label !== preset.label);
      all.push({ preset, canvas, key: "" });
      return canvas;
    },
  );
  // Holds the place until the analysis has found what each preset sets.
  const places = Array.from({ length: PLACES }, () =>
    element("span", { class: "sw-chip" }, "\u00a0"),
  );
  for (const place of places) place.prepend(element("canvas", { class: "sw-thumbnail" }));
  const waiting = element("div", { class: "sw-presets sw-preset-places", "aria-hidden": "true" });
  waiting.append(...places);
  view.panel.top.append(chips.node, waiting);

  /** What a thumbnail shows; a sun that is moved by hand changes none. @param {Preset} preset */
  const keyOf = (preset) => {
    const numbers = view.parameters.filter(({ kind }) => kind !== "data");
    return JSON.stringify([
      generation,
      ...numbers.map(({ name }) => preset.values[name] ?? view.state.values[name]),
    ]);
  };
  const busy = () => view.loop.busy || view.pointer !== null || view.state.before !== null;
  const stale = () => all.find(({ preset, key }) => key !== keyOf(preset));

  /** @type {(wait: number) => void} */
  const wake = (wait) => {
    if (signal.aborted) return;
    clearTimeout(timer);
    forget();
    timer = setTimeout(() => {
      if (!view.scene || !inSight) return;
      forget = whenIdle(draw);
    }, wait);
  };
  const draw = () => {
    if (busy()) return wake(QUIET_MS);
    const next = stale();
    if (!next) return sketch.rest();
    // None waits in a row behind others, where the next drag's frames would have to wait, too.
    if (!fence.passed()) return wake(PAUSE_MS);
    const [width, height] = view.size;
    const scale = Math.min(1, Math.sqrt(AREA / (width * height)));
    /** @type {[number, number]} */
    const size = [Math.max(1, Math.round(width * scale)), Math.max(1, Math.round(height * scale))];
    const { canvas, preset } = next;
    const frame = view.frame.describe({ ...view.state.values, ...preset.values }, size);
    if (!frame) return;
    canvas.width = Math.ceil((size[0] * DENSE) / SHRINK);
    canvas.height = Math.ceil((size[1] * DENSE) / SHRINK);
    const key = keyOf(preset);
    // Without a context there will be one when the picture is drawn again.
    if (!sketch.draw(frame, canvas)) return;
    next.key = key;
    canvas.classList.add("sw-drawn");
    wake(PAUSE_MS);
  };

  const observer = new IntersectionObserver((entries) => {
    inSight = entries[entries.length - 1].isIntersecting;
    if (inSight) wake(QUIET_MS);
  });
  observer.observe(chips.node);
  signal.addEventListener("abort", () => {
    clearTimeout(timer);
    forget();
    observer.disconnect();
    sketch.rest();
  });

  return {
    loaded() {
      generation += 1;
    },
    show() {
      chips.show();
      waiting.hidden = !chips.node.hidden;
      wake(QUIET_MS);
    },
    drawn() {
      wake(QUIET_MS);
    },
  };
}
