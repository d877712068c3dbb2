/**
 * Before and after side by side: the original photo left of a divider, the edited picture right of
 * it. The divider stays visible at every zoom.
 */

import { button } from "../../ui/button.js";
import { Divider } from "../../ui/divider.js";

/** @type {[string, string]} */
const SIDES = ["Before", "After"];

export class Split {
  /** @param {import("../types.js").Needs<"original" | "stage" | "toolbar">} needs */
  constructor({ original, stage, toolbar }) {
    this.original = original;
    this.stage = stage;
    this.on = false;
    this.button = button({
      icon: "split",
      label: "Split",
      title: "Before and after side by side (S)",
      onClick: () => this.toggle(),
    });
    this.button.setAttribute("aria-pressed", "false");
    const label = "Divider between before and after";
    this.divider = new Divider({ label, onMove: () => this.draw() });
    this.divider.node.hidden = true;
    stage.overlay.after(this.divider.node);
    toolbar.before.node.after(this.button);
  }

  toggle() {
    this.on = !this.on;
    this.button.setAttribute("aria-pressed", String(this.on));
    this.divider.node.hidden = !this.on;
    this.original.setSplit(this.on);
    this.draw();
  }

  draw() {
    const { canvas } = this.stage;
    if (!this.on) {
      canvas.style.clipPath = "";
      return;
    }
    this.divider.divide(this.stage.rectangle(), canvas, SIDES);
  }
}
