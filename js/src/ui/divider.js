/**
 * A divider between two overlaid pictures, dragged or moved with the arrow keys.
 * Styles are in `editor/view/split.css`.
 */

import { element, setAttributes } from "./element.js";
import { icon } from "./icons.js";

const KEY_STEP = 0.02; // of the width; five times as much with Shift
const ROOM = 70; // CSS pixels that a side's name needs

export class Divider {
  /**
   * @param {{ label: string, onMove: () => void }} options `onMove` is called after every move
   */
  constructor({ label, onMove }) {
    this.share = 0.5; // position from left to right
    this.offset = 0; // from the divider to where it was grabbed, CSS pixels
    this.reach = [0, 1]; // left and right limits, CSS pixels in its parent
    this.onMove = onMove;
    this.sides = [0, 1].map(() => element("span", { class: "sw-side", "aria-hidden": "true" }));
    this.node = element(
      "div",
      {
        class: "sw-divider",
        tabindex: 0,
        role: "slider",
        "aria-label": label,
        "aria-orientation": "horizontal",
        "aria-valuemin": 0,
        "aria-valuemax": 100,
      },
      ...this.sides,
      icon("divider"),
    );
    this.node.addEventListener("keydown", (event) => this.onKey(event));
    this.node.addEventListener("pointerdown", (event) => this.take(event));
    this.node.addEventListener("pointermove", (event) => this.drag(event));
    this.node.addEventListener("dblclick", () => this.moveTo(0.5));
  }

  /** @param {number} share */
  moveTo(share) {
    this.share = Math.min(1, Math.max(0, share));
    this.onMove();
  }

  /** @param {PointerEvent} event */
  take(event) {
    if (event.button) return;
    this.node.setPointerCapture(event.pointerId);
    const { left, width } = this.node.getBoundingClientRect();
    this.offset = event.clientX - (left + width / 2);
  }

  /** @param {PointerEvent} event */
  drag(event) {
    if (!this.node.hasPointerCapture(event.pointerId)) return;
    const origin = this.node.parentElement?.getBoundingClientRect().left ?? 0;
    const [left, right] = this.reach;
    this.moveTo((event.clientX - origin - this.offset - left) / Math.max(1, right - left));
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

  /**
   * Place the divider, and clip the upper canvas to the part right of it.
   *
   * @param {import("./stage.js").Box} box the picture in the divider's parent
   * @param {HTMLCanvasElement} upper
   * @param {[string, string]} names of the two sides
   */
  divide(box, upper, names) {
    const [left, right] = [Math.max(0, box.x), Math.min(box.stageWidth, box.x + box.width)];
    const [top, bottom] = [Math.max(0, box.y), Math.min(box.stageHeight, box.y + box.height)];
    this.reach = [left, right];
    const x = left + this.share * (right - left);
    Object.assign(this.node.style, {
      left: `${x}px`,
      top: `${top}px`,
      height: `${bottom - top}px`,
    });
    const percent = Math.round(100 * this.share);
    setAttributes(this.node, {
      "aria-valuenow": percent,
      "aria-valuetext": `${percent} % ${names[0]}`,
    });
    // A name without enough room would cover the other side.
    [x - left, right - x].forEach((room, i) => {
      this.sides[i].textContent = names[i];
      this.sides[i].classList.toggle("sw-tight", room < ROOM);
    });
    upper.style.clipPath = `inset(0 0 0 ${(100 * (x - box.x)) / box.width}%)`;
  }
}
