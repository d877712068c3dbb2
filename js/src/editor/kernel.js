/**
 * What stands behind the view: a kernel that answers, one that is lost, or none at all in a
 * stand-alone page. Whatever needs the kernel asks here first.
 */

/** @typedef {"live" | "lost" | "none"} KernelState */

export class Kernel {
  /** @param {import("../types.js").Model} model */
  constructor(model) {
    /** @type {KernelState} */
    this.state = model.get("_standalone") ? "none" : "live";
  }

  /** Whether corrections, maps and full-size exports can be had. */
  get answers() {
    return this.state === "live";
  }
}
