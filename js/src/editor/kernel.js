/**
 * What stands behind the view: a kernel that answers, one that is lost, or none at all in a
 * stand-alone page. Whatever needs the kernel asks here first.
 */

/** @typedef {"live" | "lost" | "none"} KernelState */

// ipywidgets marks views so while their model has no connection, and says when that changes.
const DISCONNECTED = ".jupyter-widgets-disconnected";
const CONNECTION = "comm_live_update";
// Only the kernel sets these.
const SIGNS = ["change:_status", "change:_scene", "msg:custom"];

export class Kernel {
  /**
   * @param {import("../types.js").Model} model
   * @param {HTMLElement} root
   * @param {AbortSignal} signal
   */
  constructor(model, root, signal) {
    this.model = model;
    /** @type {KernelState} */
    this.state = model.get("_standalone") ? "none" : "live";
    /** @type {Set<() => void>} */
    this.listeners = new Set();
    if (this.state === "none") return;
    const look = () => this.become(root.closest(DISCONNECTED) ? "lost" : "live");
    look();
    // The host's own view may hear of it after this one.
    const onConnection = () => setTimeout(() => signal.aborted || look());
    const onSign = () => this.become("live");
    model.on(CONNECTION, onConnection);
    for (const event of SIGNS) model.on(event, onSign);
    signal.addEventListener("abort", () => {
      model.off(CONNECTION, onConnection);
      for (const event of SIGNS) model.off(event, onSign);
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

  /** The kernel was asked, and is silent or gone. */
  lose() {
    this.become("lost");
  }

  /** Find out whether there is a way to the kernel; one that crashed does not say goodbye. */
  check() {
    if (this.state !== "live") return;
    try {
      this.model.send({ type: "still here" });
    } catch {
      this.lose();
    }
  }

  /** @param {KernelState} state */
  become(state) {
    if (state === this.state || this.state === "none") return;
    this.state = state;
    for (const listener of this.listeners) listener();
  }
}
