/**
 * Detail beyond the preview: when zoomed past the preview's pixels, the kernel renders the visible
 * part from the full-size photo, and it covers the frame while the edit rests.
 */

import { decodePicture } from "../../gl/texture.js";
import { element } from "../../ui/element.js";

const REST_MS = 800; // long enough that a continued drag does not compete for the CPU
const READY = "ready";

/**
 * @type {import("../types.js").MakePart<"channel" | "hand" | "kernel" | "picture" | "root"
 *   | "stage" | "state" | "work">}
 */
export function detail({ channel, hand, kernel, picture, root, stage, state, work }, signal) {
  const canvas = element("canvas", { class: "sw-detail", "aria-hidden": "true", hidden: true });
  stage.canvas.after(canvas);
  let scenes = 0; // how many have arrived
  let shown = ""; // the edit that the canvas shows
  let asked = ""; // the edit and part that were requested last
  let under = ""; // the edit of that request
  let request = new AbortController();
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let timer;

  const helps = () =>
    picture.scene !== null &&
    picture.scene.width > picture.size[0] &&
    !stage.zoom.fits && // a dense screen always exceeds the preview
    stage.zoom.scale > 1 &&
    kernel.answers &&
    !picture.passing;
  const rests = () =>
    !state.before && hand.pointer === null && !work.busy && root.dataset.stage === READY;
  const edit = () => JSON.stringify([scenes, state.values]);

  /** The visible part of the bitmap in fractions, and its size in screen pixels. */
  const part = () => {
    const { x, y, width, height, stageWidth, stageHeight } = stage.rectangle();
    const inside = (/** @type {number} */ at) => Math.min(1, Math.max(0, at));
    const [left, right] = [inside(-x / width), inside((stageWidth - x) / width)];
    const [top, bottom] = [inside(-y / height), inside((stageHeight - y) / height)];
    const ratio = window.devicePixelRatio || 1;
    const size = [(right - left) * width * ratio, (bottom - top) * height * ratio];
    return { box: [left, top, right, bottom], size };
  };

  const ask = async () => {
    if (!helps()) return;
    if (!rests()) {
      timer = setTimeout(ask, REST_MS);
      return;
    }
    const [of, wanted] = [edit(), part()];
    const key = of + JSON.stringify(wanted);
    if (key === asked) {
      canvas.hidden = shown !== of;
      return;
    }
    [asked, under] = [key, of];
    request.abort();
    request = new AbortController();
    try {
      const content = { ...wanted, ...picture.requestContent() };
      const answer = await channel.request("detail", content, undefined, [], request.signal);
      const bitmap = await decodePicture(answer.buffers[0]);
      if (!signal.aborted && helps() && edit() === of) put(bitmap, answer.result.box, of);
      bitmap.close();
    } catch {
      // The user did not ask for it and the frame remains; kernel failures are reported elsewhere.
    }
  };

  /** @param {ImageBitmap} bitmap @param {number[]} box @param {string} of */
  const put = (bitmap, [left, top, right, bottom], of) => {
    Object.assign(canvas, { width: bitmap.width, height: bitmap.height });
    canvas.getContext("2d", { alpha: false })?.drawImage(bitmap, 0, 0);
    Object.assign(canvas.style, {
      left: `${100 * left}%`,
      top: `${100 * top}%`,
      width: `${100 * (right - left)}%`,
      height: `${100 * (bottom - top)}%`,
    });
    canvas.hidden = false;
    shown = of;
  };

  signal.addEventListener("abort", () => {
    clearTimeout(timer);
    request.abort();
  });

  return {
    loaded() {
      scenes += 1;
    },
    draw() {
      clearTimeout(timer);
      const now = helps() ? edit() : "";
      if (now !== shown) canvas.hidden = true;
      if (now !== under) {
        request.abort(); // its result is outdated
        asked = under = "";
      }
      if (now) timer = setTimeout(ask, REST_MS);
    },
  };
}
