/**
 * One view of a comparison. One frame graph on one WebGL context draws all pictures in turn, except
 * recipes with their own strokes or hints, which have their own maps and graph. All pictures share
 * sun, zoom and pan.
 */

import { EditState } from "../edit/state.js";
import { Zoom } from "../geometry/zoom.js";
import { FrameLoop } from "../gl/frame_loop.js";
import { decodePicture } from "../gl/texture.js";
import { errorText } from "../host/error_text.js";
import { onKernelError } from "../host/kernel_errors.js";
import { savedText } from "../host/saved_state.js";
import { onTraits } from "../host/traits.js";
import { watchVisibility } from "../host/visibility.js";
import { sunText } from "../ui/angle_text.js";
import { Divider } from "../ui/divider.js";
import { element } from "../ui/element.js";
import { ErrorMessage } from "../ui/error_message.js";
import { Differences } from "./differences.js";
import { layOut, placeDivider } from "./layout.js";
import { Panel } from "./panel.js";
import { saved } from "./saved.js";
import { Scenes } from "./scenes.js";
import { listenToKeys } from "./shortcuts.js";
import { toolbar } from "./toolbar.js";

/**
 * @typedef {import("../host/types.js").Model} Model
 * @typedef {import("../host/types.js").Parameter} Parameter
 * @typedef {import("../host/types.js").Status} Status
 */

// Drawn shares of the preview's size. Few: a new one redraws all of the picture's passes.
const SHARES = [0.25, 0.375, 0.5, 0.75, 1];

// The row of the switch, which the kernel's tables lack.
const ONE_SUN = { kind: "switch", label: "One sun", section: "sun", analysis: false };

export class View {
  /**
   * @param {Model} model
   * @param {HTMLElement} root
   * @param {AbortSignal} signal ends the view
   */
  constructor(model, root, signal) {
    this.model = model;
    this.root = root;
    this.signal = signal;
    /** @type {Parameter[]} */
    this.parameters = model.get("_parameters");
    this.state = new EditState(model, this.rows(), signal);
    this.scenes = new Scenes(model, this.variants().length, signal);
    this.zoom = new Zoom();
    this.zoom.onChange = () => {
      this.layOut();
      this.request();
    };
    this.pair = [0, 1]; // of the wipe
    this.loop = new FrameLoop(
      (scale) => this.draw(scale),
      () => this.state.before !== null,
      signal,
    );
    this.loop.setVisible(false); // until the page is laid out
    watchVisibility(root, signal, (visible) => this.loop.setVisible(visible));
    this.panels = this.variants().map((_, index) => new Panel(this, index, signal));
    this.grid = element("div", { class: "sw-compare-grid" }, ...this.panels.map((p) => p.node));
    this.divider = new Divider({ label: "Divider", onMove: () => placeDivider(this) });
    this.readout = element("div", { class: "sw-readout" });
    this.message = new ErrorMessage();
    this.toolbar = toolbar(this);
    this.differences = new Differences(this);
    saved(this, signal);
    root.append(
      this.toolbar.node,
      element(
        "div",
        { class: "sw-main" },
        this.grid,
        this.message.node,
        element("div", { class: "sw-foot" }, this.readout),
      ),
    );
    listenToKeys(this, signal);
    this.listen(signal);
    this.showStatus();
    void this.loadPhoto();
    void this.loadScenes();
    this.show();
  }

  /** The sun's rows of the kernel's table and the switch, with the widget's initial values. */
  rows() {
    /** @type {{ name: string, default: unknown }[]} */
    const rows = this.model.get("_rows");
    return rows.map((row) => {
      const found = this.parameters.find(({ name }) => name === row.name);
      return /** @type {Parameter} */ ({ ...ONE_SUN, ...found, ...row });
    });
  }

  /** @param {AbortSignal} signal */
  listen(signal) {
    const { model } = this;
    onTraits(model, ["_photo"], () => void this.loadPhoto(), signal);
    onTraits(model, ["_scenes"], () => void this.loadScenes(), signal);
    onTraits(model, ["_status"], () => this.showStatus(), signal);
    onTraits(model, ["_variants", "arrangement", "difference"], () => this.show(), signal);
    onKernelError(model, (text) => this.message.show(text), signal);
    this.state.subscribe(() => this.show());
    const observer = new ResizeObserver(() => this.layOut());
    observer.observe(this.grid);
    signal.addEventListener("abort", () => observer.disconnect());
  }

  /** @returns {import("./panel.js").Variant[]} */
  variants() {
    return this.model.get("_variants");
  }

  get wipes() {
    return this.model.get("arrangement") === "wipe";
  }

  /** The visible panels. */
  shown() {
    return this.wipes ? this.pair.map((index) => this.panels[index]) : this.panels;
  }

  /** Whether the recipes have their own suns: the widget started without a common one. */
  hasOwnSuns() {
    return this.state.parameters.some((p) => p.name === "one_sun" && !p.default);
  }

  async loadPhoto() {
    await this.showPhoto(this.model.get("_photo"), this.panels);
    if (!this.model.get("_saved")) return;
    await Promise.all(this.panels.map((panel) => this.showPhoto(panel.variant.picture, [panel])));
    this.readout.textContent = savedText(this.model, "comparison");
  }

  /**
   * Show a picture until the maps are there.
   *
   * @param {DataView | undefined} bytes
   * @param {Panel[]} panels
   */
  async showPhoto(bytes, panels) {
    if (!bytes?.byteLength) return;
    try {
      const photo = await decodePicture(bytes);
      if (!this.signal.aborted) {
        this.zoom.size = [photo.width, photo.height];
        for (const panel of panels) if (!panel.drawn) panel.showPhoto(photo);
        this.layOut();
      }
      photo.close();
    } catch {
      this.message.show("The browser cannot decode the preview that the kernel sent.");
    }
  }

  async loadScenes() {
    try {
      const size = await this.scenes.load();
      if (!size) return;
      this.zoom.size = size; // perhaps before the photo is shown
      this.show();
    } catch (error) {
      this.message.show(`The analysis maps cannot be shown: ${errorText(error)}`);
    }
  }

  showStatus() {
    /** @type {Status | null} */
    const status = this.model.get("_status");
    if (!status) return;
    const working = status.stage === "opening" || status.stage === "analysing";
    this.panels[0].setProgress(working ? status.fraction : null, status.message);
    this.message.show(status.stage === "error" ? status.message : "");
  }

  /** Update everything from the state: marks at once, the pictures with the next refresh. */
  show() {
    this.toolbar.show();
    this.layOut();
    this.request();
  }

  /** Draw with the next refresh of the screen. */
  request() {
    this.grid.setAttribute("aria-busy", "true");
    this.loop.request();
  }

  /** @param {string} arrangement */
  setArrangement(arrangement) {
    this.model.set("arrangement", arrangement);
    this.model.save_changes();
  }

  /** @param {boolean} on */
  setDifference(on) {
    this.model.set("difference", on);
    this.model.save_changes();
  }

  /** @param {number} side of the wipe @param {number} index of a variant */
  setPair(side, index) {
    const other = 1 - side;
    // Do not compare a picture with itself: swap the sides.
    if (this.pair[other] === index) this.pair[other] = this.pair[side];
    this.pair[side] = index;
    this.show();
  }

  layOut() {
    if (!layOut(this)) return;
    this.toolbar.showZoom();
    this.drawMarks();
  }

  /** Size to draw, as large as the screen shows. @param {number} scale @returns {[number, number]} */
  drawSize(scale) {
    const seen = Math.min(1, this.zoom.scale);
    const share = (SHARES.find((each) => each >= 0.98 * seen) ?? 1) * scale;
    const [width, height] = this.zoom.size;
    return [Math.max(1, Math.round(width * share)), Math.max(1, Math.round(height * share))];
  }

  /** @param {number} scale of what the screen shows */
  draw(scale) {
    this.drawMarks();
    if (!this.scenes.found.length) return;
    const size = this.drawSize(scale);
    const drawn = this.message.attempt(() => this.shown().map((panel) => panel.drawPicture(size)));
    if (!drawn) return;
    if (!drawn.every(Boolean)) {
      this.request(); // a context was lost; the next frame makes a new one
      return;
    }
    this.root.classList.add("sw-live");
    if (scale < 1) return;
    this.grid.setAttribute("aria-busy", "false");
    this.differences.request();
  }

  drawMarks() {
    for (const panel of this.shown()) panel.drawMarks();
    if (!this.scenes.found.length) return;
    this.readout.textContent = this.state.values.one_sun
      ? sunText(this.panels[0].value("sun_azimuth"), this.panels[0].value("sun_elevation"))
      : "Each picture has its own sun; drag one to set a common sun";
  }
}
