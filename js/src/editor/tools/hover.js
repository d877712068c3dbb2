/** Direction under the pointer or the cross, and its color in the photo and now. */

import { directionText } from "../../ui/angle_text.js";
import { element } from "../../ui/element.js";

/** @typedef {import("../../host/types.js").Point} Point */

/** @type {import("../types.js").MakePart<"statusBar" | "hand" | "picture" | "stage">} */
export function hover({ statusBar, hand, picture, stage }, signal) {
  const direction = element("span", { class: "sw-hover-direction" });
  const [before, after] = ["In the photo", "Now"].map(makeSwatch);
  const node = element(
    "div",
    { class: "sw-hover", "aria-hidden": "true" },
    direction,
    before.node,
    element("span", { class: "sw-hover-arrow" }, "→"),
    after.node,
  );
  statusBar.readout.after(node);
  // In main memory: a GPU canvas would upload the whole photo for one pixel.
  const pixel = element("canvas", { width: 1, height: 1 });
  const sample = pixel.getContext("2d", { alpha: false, willReadFrequently: true });
  /** @type {Point | null} */
  let place = null;
  let pending = 0;

  /**
   * The sRGB of one pixel.
   *
   * @param {HTMLImageElement | HTMLCanvasElement} source
   * @param {number} width
   * @param {number} height
   */
  const read = (source, width, height) => {
    if (!sample || !place || !width) return null;
    const x = Math.min(width - 1, Math.floor(place[0] * width));
    const y = Math.min(height - 1, Math.floor(place[1] * height));
    sample.drawImage(source, x, y, 1, 1, 0, 0, 1, 1);
    return sample.getImageData(0, 0, 1, 1).data;
  };

  const show = () => {
    pending = 0;
    const inside = place?.every((at) => at >= 0 && at < 1);
    const { camera } = picture;
    node.classList.toggle("sw-shown", Boolean(place && camera));
    if (!place || !camera) return;
    direction.textContent = directionText(
      ...camera.angles(place[0] * camera.width, place[1] * camera.height),
    );
    const { photo, canvas } = stage;
    before.show(inside ? read(photo, photo.naturalWidth, photo.naturalHeight) : null);
    after.show(inside ? read(canvas, canvas.width, canvas.height) : null);
  };
  const ask = () => {
    pending ||= requestAnimationFrame(show);
  };
  signal.addEventListener("abort", () => cancelAnimationFrame(pending));

  return {
    point(at) {
      // During a drag the frame budget belongs to the tool, and nobody reads colors.
      place = hand.pointer === null ? at : null;
      ask();
    },
    drawn() {
      if (place) ask();
    },
  };
}

/** Make a swatch with its three levels. @param {string} label */
function makeSwatch(label) {
  const swatch = element("span", { class: "sw-swatch" });
  const levels = element("span", { class: "sw-rgb" });
  return {
    node: element("span", { class: "sw-hover-color", title: label }, swatch, levels),
    /** @param {Uint8ClampedArray | null} data RGBA */
    show(data) {
      const rgb = data ? [data[0], data[1], data[2]] : [];
      swatch.style.background = data ? `rgb(${rgb.join(" ")})` : "";
      levels.textContent = rgb.join(" ");
    },
  };
}
