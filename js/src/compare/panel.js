/** One picture of a comparison: its canvas, its label, and the sun's handle on it. */

import { equal } from "../edit/equality.js";
import { element, setAttributes } from "../ui/element.js";
import { listenToPointers } from "../ui/pointers.js";
import { PictureStage } from "../ui/stage.js";
import { SunTool } from "../ui/sun_tool.js";

/**
 * @typedef {import("../host/types.js").Edit} Edit
 * @typedef {import("../host/types.js").Point} Point
 * @typedef {{ label: string, recipe?: Edit, scene?: number, photo?: boolean,
 *   picture?: DataView }} Variant as sent by the kernel; only the label until the photo is
 *   analyzed. A saved notebook keeps its picture
 */

export class Panel extends PictureStage {
  /**
   * @param {import("./types.js").Needs<"scenes" | "state" | "variants" | "zoom">} view
   * @param {number} index of its variant
   * @param {AbortSignal} signal
   */
  constructor(view, index, signal) {
    const canvas = element("canvas", { class: "sw-compare-canvas", role: "img" });
    const picture = element("div", { class: "sw-compare-picture" }, canvas);
    super(picture, { className: "sw-compare-cell", signal });
    const context = canvas.getContext("2d", { alpha: false });
    if (!context) throw new Error("This browser has no 2-D canvas.");
    this.view = view;
    this.index = index;
    this.canvas = canvas;
    this.context = context;
    this.label = element("span", { class: "sw-compare-label" });
    this.difference = element("span", { class: "sw-compare-difference", hidden: true });
    this.plate = element("div", { class: "sw-compare-plate" }, this.label, this.difference);
    this.node.append(this.plate);
    this.drawn = ""; // key of the drawn picture
    this.filled = false; // whether it shows at least the photo
    const panel = this;
    this.sun = new SunTool({
      stage: panel,
      state: {
        begin: () => view.state.begin(),
        commit: () => view.state.commit(),
        cancel: () => view.state.cancel(),
        set: (changes) => view.state.set({ ...changes, one_sun: true }),
        parameters: view.state.parameters,
      },
      picture: {
        value: (name) => panel.value(name),
        get camera() {
          return view.scenes.cameras[panel.variant.scene ?? 0] ?? null;
        },
        get scene() {
          return panel.scene;
        },
      },
    });
    this.overlay.append(this.sun.node);
    const ready = () => this.scene !== null;
    listenToPointers(this, { tool: () => this.sun, ready, zoom: view.zoom }, signal);
  }

  /** @returns {Variant} */
  get variant() {
    return this.view.variants()[this.index];
  }

  get scene() {
    return this.view.scenes.found[this.variant.scene ?? 0] ?? null;
  }

  /** The edit to draw: the recipe, under the common sun if there is one. @returns {Edit} */
  edit() {
    const { recipe = {}, photo } = this.variant;
    const { sun_azimuth, sun_elevation, one_sun } = this.view.state.values;
    return one_sun && !photo ? { ...recipe, sun_azimuth, sun_elevation } : recipe;
  }

  /** A value of the handle's sun, on the photo also of the common sun. @param {string} name */
  value(name) {
    const { values } = this.view.state;
    const own = values.one_sun ? values[name] : this.variant.recipe?.[name];
    return Number(own ?? this.scene?.automatic[name] ?? 0);
  }

  /** Show the photo until its analysis arrives. @param {ImageBitmap} photo */
  showPhoto(photo) {
    this.fit(photo.width, photo.height);
    this.context.drawImage(photo, 0, 0);
    this.drawn = "";
    this.filled = true;
  }

  /**
   * @param {[number, number]} size in pixels
   * @returns {boolean} whether the canvas shows what it should; false when the context was lost
   */
  drawPicture(size) {
    const { scene } = this;
    const frame = this.view.scenes.frames[this.variant.scene ?? 0];
    if (!scene || !frame) return false;
    const edit = this.edit();
    const key = JSON.stringify([edit, size, scene.revision]);
    if (key === this.drawn) return true;
    if (!frame.draw(edit, size)) return false;
    this.fit(...size);
    this.context.drawImage(frame.canvas, 0, 0);
    this.drawn = key;
    return true;
  }

  /** @param {number} width @param {number} height */
  fit(width, height) {
    if (equal([this.canvas.width, this.canvas.height], [width, height])) return;
    this.canvas.width = width;
    this.canvas.height = height;
  }

  /** Draw label and handle. */
  drawMarks() {
    const { label } = this.variant;
    if (this.label.textContent !== label) {
      this.label.textContent = label;
      setAttributes(this.canvas, { "aria-label": label });
      setAttributes(this.sun.handle, { "aria-label": `Sun in ${label}` });
    }
    this.sun.draw();
  }
}
