/**
 * One view of a SunEditor: it draws from its own state, and the traits follow.
 *
 * The photo is shown as soon as its bytes are there; the composited frame fades in over it
 * when the analysis (`_scene`, `_layers`, `_surface`, `_backdrop`, `_clear_sky`, `_relief`, `_transfer`, `_lamps`) has arrived.
 */

import { sameRecipe } from "../../edit/equality.js";
import { parameterOf } from "../../edit/parameter.js";
import { EditState } from "../../edit/state.js";
import { Frame } from "../../gl/frame.js";
import { FrameLoop } from "../../gl/frame_loop.js";
import { Channel, GONE } from "../../host/channel.js";
import { onKernelError } from "../../host/kernel_errors.js";
import { onTraits } from "../../host/traits.js";
import { watchSight } from "../../host/visibility.js";
import { Announcer } from "../../ui/announcer.js";
import { element } from "../../ui/element.js";
import { ErrorMessage } from "../../ui/error_message.js";
import { SunTool } from "../../ui/sun_tool.js";
import { Inspector } from "../inspect/inspector.js";
import { panel } from "../panel/panel.js";
import { makeParts } from "../parts.js";
import { paintBrushMask, SUBJECTS } from "../tools/brush_mask.js";
import { BrushTool, EraseTool } from "../tools/brush_tool.js";
import { HorizonTool } from "../tools/horizon_tool.js";
import { PickTool } from "../tools/pick_tool.js";
import { listenToPointer } from "../tools/pointer.js";
import { onShortcut } from "../tools/shortcuts.js";
import { BRUSHES, StrokesLayer } from "../tools/strokes.js";
import { toolbar } from "../tools/toolbar.js";
import { Kernel } from "./kernel.js";
import { Loading } from "./loading.js";
import { Notices } from "./notices.js";
import { Stage } from "./stage.js";
import { Foot } from "./status_bar.js";

/**
 * @typedef {import("../../geometry/camera.js").Camera} Camera
 * @typedef {import("../../host/types.js").Model} Model
 * @typedef {import("../../host/types.js").Parameter} Parameter
 * @typedef {import("../../host/types.js").Point} Point
 * @typedef {import("../../host/types.js").Scene} Scene
 * @typedef {import("../../host/types.js").Status} Status
 * @typedef {{
 *   node: SVGElement, draw: () => void, end: () => void, cancel: () => void,
 *   begin: (place: Point, event: PointerEvent) => void,
 *   move: (place: Point, event: PointerEvent) => void,
 *   hover?: (place: Point | null) => void,
 *   reset?: () => void,
 *   refresh?: () => void,
 *   focus?: () => void,
 *   spot?: () => { x: number, y: number },
 *   stays?: boolean,
 *   fine?: boolean,
 * }} Tool
 */

const WORTHWHILE = 0.75; // a drag that shows less of the preview's size is drawn smaller

export class View {
  /**
   * @param {Model} model
   * @param {HTMLElement} root
   * @param {AbortSignal} signal ends the view
   */
  constructor(model, root, signal) {
    this.model = model;
    this.root = root;
    /** @type {Parameter[]} */
    this.parameters = model.get("_parameters");
    this.state = new EditState(model, this.parameters, signal);
    this.channel = new Channel(model, signal);
    this.kernel = new Kernel(model, signal);
    this.state.follow = () => this.kernel.follow;
    this.stage = new Stage(signal);
    this.frame = new Frame(this.stage.canvas, this.parameters);
    /** @type {Scene | null} */
    this.scene = null;
    /** @type {Camera | null} */
    this.camera = null;
    this.tool = "sun";
    this.brushRadius = 0.015;
    this.subject = "sky"; // what brush strokes are about
    /** @type {AbortController | null} cancels the picture that is being saved */
    this.work = null;
    /** @type {import("../../host/types.js").Edit | null} what a film shows in place of the edit */
    this.passing = null;
    /** @type {import("../../host/types.js").Edit} the edit when "Before" was turned on */
    this.hidden = {};
    this.speed = ""; // how fast the picture is drawn here, and by what (timings.js)
    /** @type {[number, number]} size of the full preview in pixels */
    this.size = [0, 0];
    /** @type {number | null} the pointer that drags */
    this.pointer = null;
    this.loop = new FrameLoop(
      (scale) => this.drawFrame(scale),
      () => this.state.before !== null || this.passing !== null,
      signal,
    );

    this.loop.limit = () => this.visibleScale();
    this.loop.setSight(false); // until the page is laid out
    watchSight(root, signal, (inSight) => this.loop.setSight(inSight));

    /** @type {Record<string, Tool>} */
    this.tools = {
      sun: new SunTool(this),
      horizon: new HorizonTool(this),
      pick: new PickTool(this),
      sky: new BrushTool(this, "sky"),
      not_sky: new BrushTool(this, "not_sky"),
      erase: new EraseTool(this),
    };
    this.strokes = new StrokesLayer(this);
    this.inspector = new Inspector(this);
    this.panel = panel(this);
    this.toolbar = toolbar(this);
    this.foot = new Foot();
    this.announcer = new Announcer(signal);
    const busy = () => this.pointer !== null || this.state.before !== null;
    this.notices = new Notices(root, busy, signal);
    this.message = new ErrorMessage();
    /** Drops what the pointer has begun, and lets it go. */
    this.cancelGesture = () => {};
    /** @type {import("./split.js").Split | null} */
    this.split = null;
    /** @type {import("./full_screen.js").FullScreen | null} */
    this.fullScreen = null;
    /** @type {import("../parts.js").Part[]} */
    this.parts = [];
    this.build();
    this.parts = makeParts(this, signal);
    this.listen(signal);
    this.showStatus();
    const loading = new Loading(this, signal);
    void loading.photo();
    void loading.scene();
    this.show();
  }

  build() {
    const { sun, horizon, pick, sky, not_sky, erase } = this.tools;
    this.stage.picture.append(this.inspector.canvas);
    this.stage.overlay.append(this.strokes.node);
    for (const tool of [horizon, pick, sky, not_sky, erase, sun]) {
      this.stage.overlay.append(tool.node);
    }
    const main = element(
      "div",
      { class: "sw-main" },
      this.stage.node,
      this.message.node,
      this.inspector.node,
      this.foot.node,
    );
    const body = element("div", { class: "sw-body" }, main, this.panel.node);
    this.root.append(this.toolbar.node, this.notices.node, body, this.announcer.node);
    this.setTool("sun");
  }

  /** @param {AbortSignal} signal */
  listen(signal) {
    const { model, stage, state } = this;
    state.subscribe(() => this.show());
    stage.onLayout = () => this.drawOverlay();
    // Said at once: a busy kernel may take its time until it reports itself.
    state.onCorrection = () => {
      this.root.dataset.stage = "analysing";
      stage.setProgress(0.04, "Waiting for the kernel …");
    };
    onTraits(model, ["_status"], () => this.showStatus(), signal);
    onKernelError(model, (text) => this.message.show(text), signal);
    // A crash of the graphics process has emptied what stands on canvases; their events do not bubble.
    const redraw = () => this.redraw();
    stage.node.addEventListener("contextrestored", redraw, { capture: true, signal });
    this.cancelGesture = listenToPointer(this, signal);
    this.kernel.onChange(() => {
      if (!this.kernel.answers) this.channel.lose(GONE);
    });
    this.channel.onGone = () => this.kernel.become("lost");
    this.root.addEventListener("keydown", (event) => onShortcut(this, event), { signal });
    signal.addEventListener("abort", () => {
      this.frame.dispose();
    });
  }

  /** @param {string} name */
  parameter(name) {
    return parameterOf(this.parameters, name);
  }

  /** What the picture shows: the edit, or a moment of a film. */
  get shown() {
    return this.passing ?? this.state.values;
  }

  /** The number in effect: the person's, or what the analysis found. @param {string} name */
  value(name) {
    return Number(this.shown[name] ?? this.scene?.automatic[name] ?? 0);
  }

  /** Take over what the analysis found. @param {Scene} scene @param {Camera} camera */
  takeScene(scene, camera) {
    this.frame.setScene(scene);
    this.scene = scene;
    this.camera = camera;
    this.foot.showScene(scene);
    this.showMask();
    void this.inspector.refresh();
    this.tools[this.tool].refresh?.();
    for (const part of this.parts) part.loaded?.(scene);
    this.show();
  }

  /** Nothing of the last photo is true of the next. */
  forgetScene() {
    this.scene = null;
    this.camera = null;
    this.root.classList.remove("sw-live");
    this.foot.showScene(null);
    this.show();
  }

  showStatus() {
    /** @type {Status | null} */
    const status = this.model.get("_status");
    if (!status) return;
    const working = status.stage === "opening" || status.stage === "analysing";
    this.stage.setProgress(working ? status.fraction : null, status.message);
    this.root.dataset.stage = status.stage;
    if (status.stage === "error") this.message.show(status.message);
    else if (status.stage === "ready") this.message.show("");
  }

  /** @param {string} tool */
  setTool(tool) {
    if (tool !== "sun" && !this.kernel.answers) return; // all others correct the analysis
    this.cancelGesture();
    this.tool = tool;
    this.root.dataset.tool = tool;
    this.root.classList.toggle("sw-brushing", BRUSHES.includes(tool));
    this.showMask();
    this.toolbar.show();
    this.tools[tool].refresh?.();
    this.drawOverlay();
  }

  /** What brush strokes are about from now on. @param {string} subject sky or water */
  setSubject(subject) {
    this.subject = subject;
    this.setTool(this.tool === "not_sky" ? "not_sky" : "sky");
  }

  /** While a brush is chosen: what the kernel holds for its subject, as a tint. */
  showMask() {
    if (!BRUSHES.includes(this.tool)) return;
    this.message.attempt(() => {
      const levels = this.frame.levels(SUBJECTS[this.subject].texture);
      if (levels) paintBrushMask(this.stage.mask, levels, this.subject);
    });
  }

  /** @param {boolean} on */
  setBefore(on) {
    if (on) this.hidden = this.state.recipe();
    this.stage.setOriginal(on || this.split?.on === true);
    this.root.classList.toggle("sw-before", on);
  }

  /** @param {number} radius fraction of the longer side */
  setBrushRadius(radius) {
    this.brushRadius = Math.min(0.06, Math.max(0.003, radius));
    this.toolbar.show();
    this.drawOverlay();
  }

  /** The picture's canvases are empty. */
  redraw() {
    this.stage.redrawOriginal();
    this.showMask();
    this.inspector.scene = null; // whose map it had painted
    void this.inspector.refresh();
    this.loop.request();
  }

  /** Everything that follows from the state: controls at once, the frame with the next refresh. */
  show() {
    const { before } = this.toolbar;
    if (before.isOn() && !sameRecipe(this.hidden, this.state.recipe())) before.letGo();
    this.panel.show();
    this.toolbar.show();
    for (const part of this.parts) part.show?.();
    this.loop.request();
  }

  /** The pointer, or the keyboard's cross, is at a place of the picture, or gone. @param {Point | null} place */
  point(place) {
    this.inspector.point(place);
    for (const part of this.parts) part.point?.(place);
  }

  /** Share of the preview's size that the screen can show; 1 where less would gain little. */
  visibleScale() {
    const shown = this.stage.rectangle().width * (window.devicePixelRatio || 1);
    const scale = shown / Math.max(1, this.size[0]);
    return scale < WORTHWHILE ? scale : 1;
  }

  /** @param {number} scale of the full size */
  drawFrame(scale) {
    this.drawOverlay();
    if (!this.scene) return;
    const [width, height] = this.size;
    /** @type {[number, number]} */
    const size = [Math.max(1, Math.round(width * scale)), Math.max(1, Math.round(height * scale))];
    const drawn = this.message.attempt(() => this.frame.draw(this.shown, size));
    if (drawn) {
      this.root.classList.add("sw-live");
      for (const part of this.parts) part.drawn?.(scale);
    } else if (drawn === false) {
      this.loop.request(); // the context was lost meanwhile; the next frame makes another
    }
  }

  drawOverlay() {
    this.strokes.draw();
    for (const tool of Object.values(this.tools)) tool.draw();
    if (this.scene) this.foot.showSun(this.value("sun_azimuth"), this.value("sun_elevation"));
    for (const part of this.parts) part.draw?.();
  }

  /**
   * What a request for a picture is about. Hosts hold traits back while the kernel is busy, and not
   * requests: without it the kernel would answer with an older edit than the person saw.
   */
  asked() {
    return { recipe: this.state.recipe(), photo: this.model.get("_source")?.fingerprint };
  }
}
