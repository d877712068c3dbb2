/**
 * One view of a SkyExplorer. It draws the sky from its own state, and the traits follow.
 *
 * Everything except Bruneton's table, the measured skies and their errors is computed here, so the
 * widget also works without a kernel.
 */

import { parameterOf } from "../edit/parameter.js";
import { EditState } from "../edit/state.js";
import { angleBetween } from "../geometry/day.js";
import { FrameLoop } from "../gl/frame_loop.js";
import { Channel } from "../host/channel.js";
import { onKernelError } from "../host/kernel_errors.js";
import { onTraits } from "../host/traits.js";
import { watchVisibility } from "../host/visibility.js";
import { Announcer } from "../ui/announcer.js";
import { element } from "../ui/element.js";
import { ErrorMessage } from "../ui/error_message.js";
import { runShortcut } from "../ui/keys.js";
import { Guides } from "./guides.js";
import { Measured } from "./measured.js";
import { panel } from "./panel.js";
import { Plots } from "./plots/plots.js";
import { listenToPointer } from "./pointer.js";
import { Projection } from "./projection.js";
import { Readout } from "./readout.js";
import { SHORTCUTS } from "./shortcuts.js";
import { SkyFrame } from "./sky_frame.js";
import { reading } from "./sky_probe.js";
import { SkyStage } from "./stage.js";
import { Sun } from "./sun.js";
import { SunHandle } from "./sun_handle.js";
import { toolbar } from "./toolbar.js";
import { Tracer } from "./tracer.js";

/**
 * @typedef {import("../host/types.js").Model} Model
 * @typedef {import("../host/types.js").Parameter} Parameter
 * @typedef {import("../host/types.js").Point} Point
 */

const MOST_PIXELS = 900_000;

export class View {
  /**
   * @param {Model} model
   * @param {HTMLElement} root
   * @param {AbortSignal} signal ends the view
   */
  constructor(model, root, signal) {
    this.id = `sw-view-${Math.random()}`; // hosts load this module anew for every widget
    this.model = model;
    this.root = root;
    /** @type {Parameter[]} */
    this.parameters = model.get("_parameters");
    this.state = new EditState(model, this.parameters, signal);
    this.channel = new Channel(model, signal);
    this.sun = new Sun(this);
    this.stage = new SkyStage(signal);
    this.frame = new SkyFrame(this.stage.canvas, this.parameters);
    this.tracer = new Tracer(this, signal);
    this.guides = new Guides(this);
    this.handle = new SunHandle(this);
    this.measured = new Measured(this);
    this.announcer = new Announcer(signal);
    this.readout = new Readout((text) => this.say(text));
    this.plots = new Plots(this, signal);
    this.panel = panel(this, signal);
    this.toolbar = toolbar(this);
    this.message = new ErrorMessage();
    /** @type {Point | null} direction under the pointer */
    this.pointed = null;
    /** @type {Point | null} direction highlighted by a plot */
    this.plotPoint = null;
    /** @type {string} key of the drawn picture */
    this.drawnKey = "";
    this.tables = 0; // number of tables that the kernel has sent
    this.loop = new FrameLoop(
      (scale) => this.drawFrame(scale),
      () => this.state.before !== null,
      signal,
    );
    this.signal = signal;
    this.loop.setVisible(false); // until the page is laid out
    this.build();
    this.listen(signal);
    this.show();
  }

  build() {
    this.stage.node.append(this.measured.legend);
    this.stage.overlay.append(this.guides.node, this.measured.dots, this.handle.node);
    const main = element(
      "div",
      { class: "sw-main" },
      this.stage.node,
      this.message.node,
      this.readout.node,
    );
    this.root.append(
      this.toolbar.node,
      element("div", { class: "sw-body" }, main, this.panel.node),
      this.plots.node,
      this.announcer.node,
    );
  }

  /** Announce the sun's position, unless the focused control does. @param {string} text */
  say(text) {
    const { activeElement } = /** @type {Document | ShadowRoot} */ (this.root.getRootNode());
    if (!activeElement?.matches(".sw-sun, input")) this.announcer.say(text);
  }

  /** @param {AbortSignal} signal */
  listen(signal) {
    const { model, state, stage } = this;
    state.subscribe(() => this.show());
    stage.onLayout = () => this.requestFrame();
    watchVisibility(this.root, signal, (visible) => {
      this.loop.setVisible(visible);
      if (visible) this.requestFrame();
    });
    const onData = () => {
      this.show();
      if (this.loop.visible) this.plots.request();
    };
    onTraits(model, ["_day", "_measured", "_scans", "_aliases", "_presets"], onData, signal);
    onKernelError(model, (text) => this.message.show(text), signal);
    listenToPointer(this, signal);
    this.root.addEventListener("keydown", (event) => runShortcut(SHORTCUTS, this, event), {
      signal,
    });
    signal.addEventListener("abort", () => {
      this.frame.dispose();
    });
  }

  /** @param {string} name */
  parameter(name) {
    return parameterOf(this.parameters, name);
  }

  /** @param {string} name @returns {number} */
  number(name) {
    return Number(this.state.values[name] ?? this.parameter(name).default ?? 0);
  }

  /** @type {(name: string, value: number) => number} */
  clamp(name, value) {
    const { minimum, maximum } = this.parameter(name);
    return Math.min(maximum, Math.max(minimum, value));
  }

  projection() {
    const { width, height } = this.stage.rectangle();
    return new Projection(String(this.state.values.projection), [width, height], {
      view_azimuth: this.number("view_azimuth"),
      view_elevation: this.number("view_elevation"),
      fov: this.number("fov"),
    });
  }

  /** Return a direction's place on the picture, or null behind the camera. @type {(direction: Point) => Point | null} */
  placeOf([azimuth, elevation]) {
    return this.projection().pixel(azimuth, elevation);
  }

  /** @type {(place: Point) => Point | null} null outside the sky */
  directionOf([x, y]) {
    return this.projection().direction(x, y);
  }

  /** As `directionOf`, or else the nearest direction toward the picture's middle. @param {Point} place */
  nearestDirection([x, y]) {
    return this.projection().nearest(x, y);
  }

  /** Degrees that the view turns per pixel. */
  degreesPerPixel() {
    const { width, height } = this.stage.rectangle();
    return this.state.values.projection === "camera" ? this.number("fov") / height : 360 / width;
  }

  /** Set the direction under the pointer. @param {Point | null} direction */
  hover(direction) {
    this.pointed = direction && direction[1] >= -90 ? direction : null;
    this.requestFrame();
  }

  /** Highlight a direction for a plot. @param {Point | null} direction */
  point(direction) {
    this.plotPoint = direction;
    this.requestFrame();
  }

  /** Update everything from the state: controls at once, the frame with the next refresh. */
  show() {
    this.stage.setProjection(String(this.state.values.projection));
    this.root.dataset.projection = String(this.state.values.projection);
    this.panel.show();
    this.toolbar.show();
    this.requestFrame();
  }

  requestFrame() {
    if (!this.loop.visible) return;
    this.stage.node.setAttribute("aria-busy", "true");
    this.loop.request();
  }

  /** @param {number} scale of the full size */
  drawFrame(scale) {
    this.drawSky(scale);
    this.drawOverlay();
    this.stage.node.setAttribute("aria-busy", String(this.loop.busy));
  }

  /** @param {number} scale of the full size */
  drawSky(scale) {
    const { width, height } = this.stage.rectangle();
    if (width < 8 || height < 8) return;
    const dense = Math.min(window.devicePixelRatio || 1, Math.sqrt(MOST_PIXELS / (width * height)));
    const size = /** @type {[number, number]} */ (
      [width, height].map((side) => Math.max(1, Math.round(side * dense * scale)))
    );
    const key = JSON.stringify([this.state.values, size, this.tables]);
    // A hovering pointer changes no pixel.
    if (key === this.drawnKey && !this.tracer.works) return;
    const drawn = this.message.attempt(() => this.frame.draw(this.state.values, size));
    if (drawn) {
      this.drawnKey = key;
      this.root.classList.add("sw-live");
      this.plots.request();
      if (this.tracer.works) this.tracer.continue();
    } else if (drawn === false) {
      this.requestFrame(); // the context was lost; the next frame makes a new one
    }
  }

  drawOverlay() {
    this.guides.draw();
    this.handle.draw();
    this.measured.draw();
    this.readout.showSun(this.sun.direction());
    this.readout.showNote(this.panel.note());
    const { pointed } = this;
    const angle = pointed ? angleBetween(pointed, this.sun.direction()) : 0;
    this.readout.showHover(pointed, pointed && this.read(pointed), angle);
    this.guides.point(this.plotPoint);
    this.plots.hover(pointed && angle);
  }

  /** Read the drawn sky in one direction. @param {Point} direction */
  read(direction) {
    const texels = this.radiances([direction]);
    return texels && reading(texels.subarray(0, 4));
  }

  /**
   * Return the model's radiances at the four wavelengths in the given directions.
   *
   * @param {Point[]} directions
   * @returns {Float32Array | null} four numbers each
   */
  radiances(directions) {
    return this.message.attempt(() => this.frame.radiances(directions));
  }
}
