/**
 * What stands behind the view: a kernel that answers, one that is lost, or none at all in a
 * stand-alone page. Whatever needs the kernel asks here first.
 */

import { ownModel } from "../../host/saved_state.js";

/**
 * @typedef {import("../../host/types.js").Model} Model
 * @typedef {"live" | "lost" | "none"} KernelState
 */

// What ipywidgets fires when a model has lost its connection, or got one.
const CONNECTION = "comm_live_update";
const PATIENCE_MS = 15_000; // a kernel that works on something else may take its time
// Only the kernel sets these.
const SIGNS = ["change:_status", "change:_scene", "msg:custom"];

export class Kernel {
  /**
   * @param {Model} model
   * @param {AbortSignal} signal
   */
  constructor(model, signal) {
    this.model = model;
    /** @type {KernelState} */
    this.state = model.get("_standalone") ? "none" : "live";
    /** Whether it was asked and said nothing: it is busy, or was restarted behind the host's back. */
    this.silent = false;
    this.asked = false;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
    /** @type {Set<() => void>} */
    this.listeners = new Set();
    if (this.state === "none") return;
    const onConnection = () => this.become(isConnected(model) ? "live" : "lost");
    onConnection();
    const onSign = () => {
      this.asked = false;
      clearTimeout(this.timer);
      this.setSilent(false);
      this.become("live");
    };
    model.on(CONNECTION, onConnection);
    for (const event of SIGNS) model.on(event, onSign);
    if (this.state === "live") this.ask();
    signal.addEventListener("abort", () => {
      model.off(CONNECTION, onConnection);
      for (const event of SIGNS) model.off(event, onSign);
      clearTimeout(this.timer);
      this.listeners.clear();
    });
  }

  /** Whether corrections, maps and full-size exports can be had. */
  get answers() {
    return this.state === "live";
  }

  /** When the photo's maps can follow a correction. @returns {"now" | "later" | "never"} */
  get follow() {
    return /** @type {const} */ ({ live: "now", lost: "later", none: "never" })[this.state];
  }

  /** @param {() => void} listener called after every change of the state */
  onChange(listener) {
    this.listeners.add(listener);
  }

  /** Ask for a sign of life: a kernel that crashed does not say goodbye. */
  check() {
    if (this.state !== "live" || this.asked) return;
    this.asked = true;
    this.timer = setTimeout(() => this.setSilent(true), PATIENCE_MS);
    this.ask();
  }

  /**
   * JupyterLab opens a widget's way past busy cells with its first message, which itself has to wait:
   * sent with the view, so that a person's first stroke need not.
   */
  ask() {
    try {
      this.model.send({ type: "request", id: "alive", action: "alive" });
    } catch {
      this.become("lost");
    }
  }

  /** @param {boolean} silent */
  setSilent(silent) {
    if (silent === this.silent) return;
    this.silent = silent;
    this.tell();
  }

  /** @param {KernelState} state */
  become(state) {
    if (state === this.state || this.state === "none") return;
    this.state = state;
    clearTimeout(this.timer);
    this.asked = false;
    this.tell();
  }

  tell() {
    for (const listener of this.listeners) listener();
  }
}

/**
 * Whether a model has a way to a kernel. A page that was saved with its widgets shows them without
 * one. Hosts without ipywidgets do not say, and are believed.
 *
 * @param {Model} model
 */
function isConnected(model) {
  return ownModel(model)?.comm_live !== false;
}
