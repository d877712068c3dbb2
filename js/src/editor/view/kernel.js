/**
 * State of the view's kernel: live, lost, or none in a stand-alone page. Code that needs the kernel
 * checks here first.
 */

import { ownModel } from "../../host/saved_state.js";

/**
 * @typedef {import("../../host/types.js").Model} Model
 * @typedef {"live" | "lost" | "none"} KernelState
 */

// Fired by ipywidgets when a model loses or gains its connection.
const CONNECTION = "comm_live_update";
const PATIENCE_MS = 15_000; // a busy kernel may take this long to answer
// Only the kernel sets these.
const LIFE_SIGNS = ["change:_status", "change:_scene", "msg:custom"];

export class Kernel {
  /**
   * @param {Model} model
   * @param {AbortSignal} signal
   */
  constructor(model, signal) {
    this.model = model;
    /** @type {KernelState} */
    this.state = model.get("_standalone") ? "none" : "live";
    /** Whether it has not answered: it is busy, or was restarted without the host noticing. */
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
    for (const event of LIFE_SIGNS) model.on(event, onSign);
    if (this.state === "live") this.ask();
    signal.addEventListener("abort", () => {
      model.off(CONNECTION, onConnection);
      for (const event of LIFE_SIGNS) model.off(event, onSign);
      clearTimeout(this.timer);
      this.listeners.clear();
    });
  }

  /** Whether corrections, maps and full-size exports are available. */
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

  /** Ask for a sign of life: a kernel does not announce that it crashed. */
  check() {
    if (this.state !== "live" || this.asked) return;
    this.asked = true;
    this.timer = setTimeout(() => this.setSilent(true), PATIENCE_MS);
    this.ask();
  }

  /**
   * JupyterLab lets a widget bypass busy cells from its second message on; the first one waits. Send
   * it with the view, so that the user's first stroke does not wait.
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
    this.notify();
  }

  /** @param {KernelState} state */
  become(state) {
    if (state === this.state || this.state === "none") return;
    this.state = state;
    clearTimeout(this.timer);
    this.asked = false;
    this.notify();
  }

  notify() {
    for (const listener of this.listeners) listener();
  }
}

/**
 * Whether a model is connected to a kernel. A page saved with its widgets shows them without one.
 * Hosts without ipywidgets do not report it, so they count as connected.
 *
 * @param {Model} model
 */
function isConnected(model) {
  return ownModel(model)?.comm_live !== false;
}
