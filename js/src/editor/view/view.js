/**
 * One view of a SunEditor. It draws from its own state, and the traits follow.
 *
 * The photo is shown as soon as its bytes arrive; the composited frame fades in over it
 * when the analysis (`_scene`, `_layers`, `_surface`, `_backdrop`, `_clear_sky`, `_relief`, `_transfer`, `_lamps`) has arrived.
 */

import { EditState } from "../../edit/state.js";
import { Channel, GONE } from "../../host/channel.js";
import { onKernelError } from "../../host/kernel_errors.js";
import { onTraits } from "../../host/traits.js";
import { Announcer } from "../../ui/announcer.js";
import { element } from "../../ui/element.js";
import { ErrorMessage } from "../../ui/error_message.js";
import { SunTool } from "../../ui/sun_tool.js";
import { Work } from "../export/work.js";
import { Inspector } from "../inspect/inspector.js";
import { panel } from "../panel/panel.js";
import { Parts } from "../part.js";
import { makeParts } from "../parts.js";
import { BrushMask } from "../tools/brush_mask.js";
import { BrushTool, EraseTool } from "../tools/brush_tool.js";
import { Hand } from "../tools/hand.js";
import { HorizonTool } from "../tools/horizon_tool.js";
import { PickTool } from "../tools/pick_tool.js";
import { listenToPointer } from "../tools/pointer.js";
import { BRUSHES, StrokesLayer } from "../tools/strokes.js";
import { toolbar } from "../tools/toolbar.js";
import { Drawing } from "./drawing.js";
import { Kernel } from "./kernel.js";
import { Loading } from "./loading.js";
import { Notices } from "./notices.js";
import { Original } from "./original.js";
import { Picture } from "./picture.js";
import { Stage } from "./stage.js";
import { showStatus } from "./status.js";
import { StatusBar } from "./status_bar.js";

/** @typedef {import("../../host/types.js").Model} Model */

export class View {
  /**
   * @param {Model} model
   * @param {HTMLElement} root
   * @param {AbortSignal} signal ends the view
   */
  constructor(model, root, signal) {
    this.model = model;
    this.root = root;
    this.parts = new Parts();
    this.state = new EditState(model, model.get("_parameters"), signal);
    this.channel = new Channel(model, signal);
    this.kernel = new Kernel(model, signal);
    this.state.follow = () => this.kernel.follow;
    this.picture = new Picture(model, this.state);
    this.stage = new Stage(signal);
    this.message = new ErrorMessage();
    this.drawing = new Drawing(this, signal);
    this.announcer = new Announcer(signal);
    this.hand = new Hand(this.kernel);
    const busy = () => this.hand.pointer !== null || this.state.before !== null;
    this.notices = new Notices(root, busy, signal);
    this.work = new Work(this);
    this.original = new Original(this);
    this.mask = new BrushMask(this);
    this.strokes = new StrokesLayer(this);
    this.hand.tools = {
      sun: new SunTool(this),
      horizon: new HorizonTool(this),
      pick: new PickTool(this),
      sky: new BrushTool(this, "sky"),
      not_sky: new BrushTool(this, "not_sky"),
      erase: new EraseTool(this),
    };
    this.inspector = new Inspector(this);
    this.panel = panel(this);
    this.toolbar = toolbar(this);
    this.statusBar = new StatusBar(this.picture);
    this.build();
    this.parts.add(...makeParts(this, signal), this.drawing);
    this.listen(signal);
    showStatus(this);
    const loading = new Loading(this, signal);
    void loading.photo();
    void loading.scene();
    this.parts.show();
  }

  build() {
    const { statusBar, hand, inspector, mask, parts, stage, strokes } = this;
    const { sun, horizon, pick, sky, not_sky, erase } = hand.tools;
    const tools = [horizon, pick, sky, not_sky, erase, sun];
    parts.add(statusBar, mask, inspector, hand, strokes, ...tools, this.panel, this.toolbar);
    stage.picture.append(inspector.canvas);
    stage.overlay.append(strokes.node, ...tools.map(({ node }) => node));
    const main = element(
      "div",
      { class: "sw-main" },
      stage.node,
      this.message.node,
      inspector.node,
      statusBar.node,
    );
    const body = element("div", { class: "sw-body" }, main, this.panel.node);
    this.root.append(this.toolbar.node, this.notices.node, body, this.announcer.node);
    hand.onTool = () => this.showTool();
    hand.setTool("sun");
  }

  /** @param {AbortSignal} signal */
  listen(signal) {
    const { channel, hand, kernel, model, parts, root, stage, state } = this;
    state.subscribe(() => parts.show());
    stage.onLayout = () => parts.draw();
    // Show progress at once: a busy kernel may report late.
    state.onCorrection = () => {
      root.dataset.stage = "analysing";
      stage.setProgress(0.04, "Waiting for the kernel …");
    };
    onTraits(model, ["_status"], () => showStatus(this), signal);
    onKernelError(model, (text) => this.message.show(text), signal);
    // A crash of the graphics process clears canvases; their events do not bubble.
    const redraw = () => this.redraw();
    stage.node.addEventListener("contextrestored", redraw, { capture: true, signal });
    hand.cancel = listenToPointer(this, signal);
    hand.onBrush = () => {
      this.toolbar.show();
      parts.draw();
    };
    this.work.onChange = () => this.toolbar.show();
    kernel.onChange(() => {
      if (!kernel.answers) channel.rejectAll(GONE);
    });
    channel.onGone = () => kernel.become("lost");
    signal.addEventListener("abort", () => {
      this.drawing.frame.dispose();
    });
  }

  /** Update the view after a tool was selected. */
  showTool() {
    const { tool, tools } = this.hand;
    this.root.dataset.tool = tool;
    this.root.classList.toggle("sw-brushing", BRUSHES.includes(tool));
    this.mask.paint();
    this.toolbar.show();
    tools[tool].refresh?.();
    this.parts.draw();
  }

  /** Redraw the picture's canvases after they were cleared. */
  redraw() {
    this.stage.redrawOriginal();
    this.mask.paint();
    this.inspector.repaint();
    this.drawing.loop.request();
  }
}
