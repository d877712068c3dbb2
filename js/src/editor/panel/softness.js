/**
 * The histogram of the sky's whiteness, with m_min and m_max as draggable lines.
 *
 * Between them the softness C^s rises from 0 to 1; they are well chosen when it is spread out
 * (thesis 4.2). The kernel counts with the measure of the method that found the clouds.
 */

import { parameterOf } from "../../edit/parameter.js";
import { element, setAttributes, shape } from "../../ui/element.js";
import { gradient } from "../inspect/ramp.js";
import { outline, spread } from "./whiteness.js";

const WIDTH = 240;
const HEIGHT = 56;
const NAMES = ["cloud_ratio_min", "cloud_ratio_max"];
const APART = 0.02; // m_max stays above m_min
const STEP = 0.01;

export class Softness {
  /**
   * @param {import("../types.js").Needs<"picture" | "state">} needs
   * @param {import("../../host/types.js").SceneMap["ramp"]} [ramp] colors of the softness map
   */
  constructor({ picture, state }, ramp) {
    this.picture = picture;
    this.state = state;
    /** @type {unknown} what the bars show */
    this.drawn = null;
    this.bars = shape("path", { class: "sw-histogram-bars" });
    this.between = shape("rect", { class: "sw-histogram-between", y: 0, height: HEIGHT });
    this.lines = NAMES.map((name, i) => this.handle(name, i));
    this.svg = shape(
      "svg",
      {
        class: "sw-histogram",
        viewBox: `0 -4 ${WIDTH} ${HEIGHT + 8}`,
        preserveAspectRatio: "none",
      },
      this.between,
      this.bars,
      ...this.lines,
    );
    this.ramp = element("div", { class: "sw-histogram-ramp" });
    if (ramp) this.ramp.style.backgroundImage = gradient(ramp);
    this.numbers = element("span", { class: "sw-unit" });
    this.text = element("p", { class: "sw-histogram-text", role: "status" });
    this.node = element(
      "div",
      { class: "sw-softness" },
      element(
        "div",
        {
          class: "sw-histogram-title",
          title: "Red over blue, or a similar measure. Drag m_min and m_max to spread the softness",
        },
        element("span", {}, "Whiteness of the sky"),
        this.numbers,
      ),
      this.svg,
      element("div", { class: "sw-histogram-track" }, this.ramp),
      this.text,
    );
    this.dragged = -1;
    this.svg.addEventListener("pointerdown", (event) => this.onDown(event));
    this.svg.addEventListener("pointermove", (event) => {
      if (this.dragged >= 0) this.set(this.dragged, this.ratioAt(event));
    });
    this.svg.addEventListener("lostpointercapture", () => {
      this.dragged = -1;
      this.state.commit();
    });
    this.svg.addEventListener("dblclick", () => {
      const defaults = NAMES.map((name) => [name, parameterOf(state.parameters, name).default]);
      state.set(Object.fromEntries(defaults));
    });
  }

  /** @param {string} name @param {number} index */
  handle(name, index) {
    const p = parameterOf(this.state.parameters, name);
    const node = shape(
      "g",
      { class: "sw-histogram-line", tabindex: 0, role: "slider", "aria-label": p.label },
      shape("line", { y1: -4, y2: HEIGHT + 4 }),
      shape("circle", { cy: index ? HEIGHT - 8 : 8, r: 4.5 }),
    );
    node.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: -STEP, ArrowRight: STEP }[event.key];
      if (!step) return;
      event.preventDefault();
      event.stopPropagation();
      this.set(index, this.limits()[index] + step * (event.shiftKey ? 10 : 1));
    });
    for (const end of ["keyup", "blur"]) {
      node.addEventListener(end, () => this.state.commit());
    }
    return node;
  }

  measured() {
    return this.picture.scene?.whiteness ?? { method: "", reach: 1, shares: [] };
  }

  /** m_min and m_max. */
  limits() {
    return NAMES.map((name) => this.picture.value(name));
  }

  /** @param {PointerEvent} event */
  ratioAt(event) {
    const box = this.svg.getBoundingClientRect();
    return ((event.clientX - box.left) / box.width) * this.measured().reach;
  }

  /** Drag the nearer line. @param {PointerEvent} event */
  onDown(event) {
    if (event.button > 0) return;
    event.preventDefault();
    const at = this.ratioAt(event);
    const { reach } = this.measured();
    const [low, high] = this.limits().map((n) => Math.min(n, reach));
    this.dragged = Math.abs(at - low) < Math.abs(at - high) ? 0 : 1;
    this.lines[this.dragged].focus({ preventScroll: true });
    this.svg.setPointerCapture(event.pointerId);
  }

  /** @param {number} index @param {number} ratio */
  set(index, ratio) {
    const p = parameterOf(this.state.parameters, NAMES[index]);
    const [low, high] = this.limits();
    const least = index ? low + APART : p.minimum;
    const most = index ? p.maximum : high - APART;
    const value = Math.round(Math.min(most, Math.max(least, ratio)) * 100) / 100;
    this.state.begin();
    this.state.set({ [p.name]: value });
  }

  show() {
    const { method, reach, shares } = this.measured();
    if (shares !== this.drawn) {
      setAttributes(this.bars, { d: outline(shares, WIDTH, HEIGHT) });
      this.drawn = shares;
    }
    const limits = this.limits();
    const [x0, x1] = limits.map((n) => Math.min(1, n / reach) * WIDTH);
    setAttributes(this.between, { x: x0, width: Math.max(0, x1 - x0) });
    this.lines.forEach((node, i) => {
      setAttributes(node, {
        transform: `translate(${i ? x1 : x0} 0)`,
        "aria-valuemin": 0,
        "aria-valuemax": parameterOf(this.state.parameters, NAMES[i]).maximum,
        "aria-valuenow": limits[i].toFixed(2),
      });
    });
    this.numbers.textContent = `m ${limits.map((n) => n.toFixed(2)).join(" – ")}`;
    this.ramp.style.marginLeft = `${(100 * x0) / WIDTH}%`;
    this.ramp.style.width = `${(100 * (x1 - x0)) / WIDTH}%`;
    const [clear, soft, white] = spread(shares, reach, limits[0], limits[1]);
    // Un-mixing needs no thresholds; only the thesis's own methods use them anyway.
    const idle = method === "unmix" && this.state.values.method === "ratio";
    this.node.classList.toggle("sw-idle", idle);
    this.text.classList.remove("sw-warn");
    if (idle) {
      this.text.textContent = "Clouds are un-mixed: no thresholds are needed.";
      return;
    }
    if (clear + soft + white === 0) {
      this.text.textContent = this.picture.scene ? "No sky to measure." : "";
      return;
    }
    const say = (/** @type {number} */ share) => `${Math.round(100 * share)} %`;
    const narrow = soft < 0.05 ? " Not spread: move the lines to the sky's values." : "";
    this.text.textContent = `Clear ${say(clear)} · soft ${say(soft)} · white ${say(white)}.${narrow}`;
    this.text.classList.toggle("sw-warn", narrow !== "");
  }
}
