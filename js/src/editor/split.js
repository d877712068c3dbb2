/**
 * Before and after side by side: left of a divider the photo as it was, right of it the picture now.
 * The divider is dragged, or moved with the arrow keys; it stays in sight at every zoom.
 */

import { button } from "../controls/button.js";
import { element, setAttributes } from "../controls/element.js";
import { icon } from "../controls/icons.js";

const KEY_STEP = 0.02; // of the way; with Shift five times as much

export class Split {
  /**
   * @param {import("./view.js").View} view
   * @param {AbortSignal} signal
   */
  constructor(view, signal) {
    this.view = view;
    this.on = false;
    this.share = 0.5; // of the picture's width in sight
    this.offset = 0; // from the divider to where it was taken hold of, CSS pixels
    this.button = button({
      icon: "split",
      label: "Split",
      title: "Before and after side by side (S)",
      onClick: () => this.toggle(),
    });
    this.button.setAttribute("aria-pressed", "false");
    this.grip = element("div", {
      class: "sw-divider",
      tabindex: 0,
      role: "slider",
      "aria-label": "Divider between before and after",
      "aria-orientation": "horizontal",
      "aria-valuemin": 0,
      "aria-valuemax": 100,
      hidden: true,
    });
    this.labels = ["Before", "After"].map((text) =>
      element("span", { class: "sw-side", "aria-hidden": "true" }, text),
    );
    this.grip.append(...this.labels, icon("divider"));
    view.stage.overlay.after(this.grip);
    view.toolbar.before.node.after(this.button);
    const { grip } = this;
    grip.addEventListener("keydown", (event) => this.onKey(event), { signal });
    grip.addEventListener("pointerdown", (event) => this.take(event), { signal });
    grip.addEventListener("pointermove", (event) => this.move(event), { signal });
    grip.addEventListener("dblclick", () => this.moveTo(0.5), { signal });
  }

  toggle() {
    this.on = !this.on;
    this.button.setAttribute("aria-pressed", String(this.on));
    this.grip.hidden = !this.on;
    this.view.root.classList.toggle("sw-split", this.on);
    this.draw();
    if (this.on && this.view.stage.node.matches(":focus-visible")) this.grip.focus();
  }

  /** Left and right end of what is in sight of the picture, on the stage. */
  reach() {
    const { x, width, stageWidth } = this.view.stage.rectangle();
    return [Math.max(0, x), Math.min(stageWidth, x + width)];
  }

  /** @param {number} share */
  moveTo(share) {
    this.share = Math.min(1, Math.max(0, share));
    this.draw();
  }

  /** @param {PointerEvent} event */
  take(event) {
    if (event.button) return;
    this.grip.setPointerCapture(event.pointerId);
    const { left, width } = this.grip.getBoundingClientRect();
    this.offset = event.clientX - (left + width / 2);
  }

  /** @param {PointerEvent} event */
  move(event) {
    if (!this.grip.hasPointerCapture(event.pointerId)) return;
    const [left, right] = this.reach();
    const [x] = this.view.stage.pointOf(event);
    this.moveTo((x - this.offset - left) / Math.max(1, right - left));
  }

  /** @param {KeyboardEvent} event */
  onKey(event) {
    const step = KEY_STEP * (event.shiftKey ? 5 : 1);
    /** @type {Record<string, number>} */
    const places = {
      ArrowLeft: this.share - step,
      ArrowDown: this.share - step,
      ArrowRight: this.share + step,
      ArrowUp: this.share + step,
      Home: 0,
      End: 1,
    };
    if (!(event.key in places) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    this.moveTo(places[event.key]);
  }

  draw() {
    const { stage } = this.view;
    if (!this.on) {
      stage.canvas.style.clipPath = "";
      return;
    }
    const box = stage.rectangle();
    const [left, right] = this.reach();
    const x = left + this.share * (right - left);
    const hidden = (x - box.x) / box.width;
    stage.canvas.style.clipPath = `inset(0 0 0 ${100 * hidden}%)`;
    const [top, bottom] = [Math.max(0, box.y), Math.min(box.stageHeight, box.y + box.height)];
    Object.assign(this.grip.style, {
      left: `${x}px`,
      top: `${top}px`,
      height: `${bottom - top}px`,
    });
    setAttributes(this.grip, {
      "aria-valuenow": Math.round(100 * this.share),
      "aria-valuetext": `${Math.round(100 * this.share)} % before`,
    });
    // A label with no room of its own would lie over the other side.
    [x - left, right - x].forEach((room, i) => {
      this.labels[i].classList.toggle("sw-tight", room < 70);
    });
  }
}

/** @type {import("./parts.js").MakePart} */
export function split(view, signal) {
  view.split = new Split(view, signal);
  return view.split;
}
