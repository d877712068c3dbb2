/**
 * The plots beside the sky, drawn from the curves that the graph computes for the current state.
 *
 * They follow the picture with a delay: after a frame, at most ten times a second during a drag, and
 * always once more at the end.
 */

import { element } from "../../ui/element.js";
import { icon } from "../../ui/icons.js";
import { followTheme, readTheme } from "../../ui/theme.js";
import { PhasePlot } from "./phase.js";
import { PrincipalPlanePlot } from "./principal_plane.js";
import { SunColorPlot } from "./sun_color.js";
import { TransmittancePlot } from "./transmittance.js";
import { ZenithElevationPlot, ZenithTrackPlot } from "./zenith.js";

const PAUSE_MS = 100;
const COLORS = [
  ...["text", "quiet", "line", "panel", "accent", "rayleigh", "aerosol", "ozone"],
  ...["nm640", "nm580", "nm510", "nm440"],
];

/**
 * @typedef {import("./types.js").Context} Context
 * @typedef {import("./types.js").Links} Links
 * @typedef {import("./types.js").Plot} Plot
 */

export class Plots {
  /**
   * @param {import("../types.js").Needs<"frame" | "measured" | "message" | "number" | "point" | "root"
   *   | "state" | "sun">} view
   * @param {AbortSignal} signal
   */
  constructor(view, signal) {
    this.view = view;
    this.theme = followTheme(view.root, COLORS, () => this.redraw(), signal);
    /** @type {Links} */
    const links = {
      moveSun: (chart) => this.dragSun(chart),
      point: (direction) => view.point(direction),
    };
    /** @type {Plot[]} */
    const plots = [
      new PhasePlot(this.theme),
      new TransmittancePlot(this.theme),
      new SunColorPlot(this.theme, links),
      new PrincipalPlanePlot(this.theme, links),
      new ZenithTrackPlot(this.theme),
      new ZenithElevationPlot(this.theme, links),
    ];
    this.cards = plots.map((plot) => this.card(plot));
    const grid = element("div", { class: "sw-plot-grid" }, ...this.cards.map((card) => card.node));
    const heading = element("summary", {}, icon("chevron"), element("span", {}, "Plots"));
    this.node = element("details", { class: "sw-section sw-plots", open: true }, heading, grid);
    this.node.addEventListener("toggle", () => this.request());
    this.last = 0;
    this.cost = 0;
    /** @type {number | null} */
    this.angle = null;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
    const observer = new ResizeObserver(() => {
      for (const { plot, body } of this.cards) plot.chart.resize(Math.floor(body.clientWidth));
    });
    for (const { body } of this.cards) observer.observe(body);
    signal.addEventListener("abort", () => {
      observer.disconnect();
      clearTimeout(this.timer);
      for (const { plot } of this.cards) plot.chart.dispose();
    });
  }

  /** @param {Plot} plot */
  card(plot) {
    const value = element("span", { class: "sw-card-value" });
    const help = element("p", { class: "sw-hint", hidden: true }, plot.help);
    const ask = element(
      "button",
      {
        type: "button",
        class: "sw-button sw-ask",
        "aria-label": `About: ${plot.title}`,
        "aria-expanded": "false",
        title: plot.help,
      },
      icon("help"),
    );
    ask.addEventListener("click", () => {
      help.hidden = !help.hidden;
      ask.setAttribute("aria-expanded", String(!help.hidden));
    });
    // Not `details`: buttons inside its summary are hidden from assistive technology.
    const fold = element(
      "button",
      { type: "button", class: "sw-card-fold", "aria-expanded": "true" },
      icon("chevron"),
      element("span", {}, plot.title),
    );
    const head = element(
      "div",
      { class: "sw-card-head" },
      fold,
      value,
      ...(plot.extra ? [plot.extra] : []),
      ask,
    );
    const body = element("div", { class: "sw-card-body" }, plot.node);
    const node = element(
      "div",
      { class: "sw-card", role: "group", "aria-label": plot.title },
      head,
      help,
      body,
    );
    fold.addEventListener("click", () => {
      body.hidden = !body.hidden;
      fold.setAttribute("aria-expanded", String(!body.hidden));
      this.request();
    });
    return { plot, node, body, value };
  }

  /** Draw soon; requests made while a drawing is pending are merged. */
  request() {
    if (this.timer !== undefined || !this.node.open) return;
    this.node.setAttribute("aria-busy", "true");
    const since = performance.now() - this.last;
    // A slow machine draws them less often, so that the drag stays fluid.
    const pause = Math.max(PAUSE_MS, 3 * this.cost);
    this.timer = setTimeout(
      () => {
        this.timer = undefined;
        this.update();
        this.node.setAttribute("aria-busy", "false");
      },
      Math.max(0, pause - since),
    );
  }

  update() {
    const begin = performance.now();
    readTheme(this.view.root, COLORS, this.theme);
    /** @type {Map<string, Float32Array>} */
    const read = new Map();
    const curve = (/** @type {string} */ pass) => {
      const texels = read.get(pass) ?? this.view.frame.curve(pass);
      read.set(pass, texels);
      return texels;
    };
    /** @type {Context} */
    const context = {
      curve,
      sun: this.view.sun.direction(),
      altitude: this.view.number("altitude"),
      measured: this.view.measured.scan(),
      scatteringAngle: this.angle,
    };
    this.view.message.attempt(() => {
      for (const { plot, body, value } of this.cards) {
        if (body.hidden) continue;
        plot.update(context);
        value.textContent = plot.summary?.() ?? "";
      }
    });
    this.last = performance.now();
    this.cost = this.last - begin;
  }

  /** Show the angle between the sun and the pointer. @param {number | null} angle degrees */
  hover(angle) {
    if (angle === this.angle) return;
    this.angle = angle;
    for (const { plot, body, value } of this.cards) {
      if (!plot.hover || body.hidden) continue;
      plot.hover(angle);
      value.textContent = plot.summary?.() ?? "";
    }
  }

  redraw() {
    for (const { plot } of this.cards) plot.chart.redraw();
  }

  /** Let a plot whose abscissa is the sun's elevation move the sun. @param {import("./chart.js").Chart} chart */
  dragSun(chart) {
    const { view } = this;
    const { target } = chart;
    target.classList.add("sw-chart-drag");
    /** @type {number | null} */
    let pointer = null;
    const move = (/** @type {PointerEvent} */ event) => {
      const over = chart.plot?.over.getBoundingClientRect();
      if (!over || !chart.plot) return;
      const elevation = chart.plot.posToVal(event.clientX - over.left, "x");
      if (!Number.isFinite(elevation)) return;
      view.state.begin();
      view.sun.moveTo(view.sun.direction()[0], elevation);
    };
    target.addEventListener("pointerdown", (event) => {
      if (event.button > 0) return;
      pointer = event.pointerId;
      target.setPointerCapture(pointer);
      move(event);
    });
    target.addEventListener("pointermove", (event) => {
      if (event.pointerId === pointer) move(event);
    });
    target.addEventListener("lostpointercapture", () => {
      pointer = null;
      view.state.commit();
    });
  }
}
