/**
 * The horizon line with a handle at either end: the kernel answers with a new camera.
 *
 * It may lie outside the picture; the handles then wait at the stage's edge. Shift keeps the line
 * level; a double click returns to the detected horizon.
 */

import { setAttributes, shape } from "../../ui/element.js";
import { labelRows } from "../panel/label_rows.js";

/** @typedef {import("../../host/types.js").Point} Point */

const ENDS = [0.12, 0.88]; // positions of the handles, fractions of the visible width
const GRAB = 40; // CSS pixels from a handle within which a press grabs it
const EDGE = 16; // CSS pixels from the stage's edge at which an outside handle waits
const GUESSED = 0.3; // confidence below which the horizon is a guess
const LABEL = 13; // height of another line's label, CSS pixels
const UNCERTAIN = 0.5; // confidence below which it may be a roof or hill (analysis/notices.py)

/** Labels of the kernel's methods. @type {Record<string, string>} */
const OTHERS = { row_argmax: "thesis row", robust_line: "skyline", water_line: "water line" };

export class HorizonTool {
  /**
   * @param {import("../types.js").Needs<"channel" | "hand" | "parts" | "picture" | "stage"
   *   | "state">} needs
   */
  constructor({ channel, hand, parts, picture, stage, state }) {
    this.channel = channel;
    this.hand = hand;
    this.parts = parts;
    this.picture = picture;
    this.stage = stage;
    this.state = state;
    /** @type {[Point, Point] | null} the line while it is dragged */
    this.line = null;
    this.moved = false;
    /** @type {0 | 1 | "both"} */
    this.grip = "both";
    /** @type {Point} */
    this.last = [0, 0];
    this.shadow = shape("line", { class: "sw-horizon-shadow" });
    this.path = shape("line", { class: "sw-horizon-line" });
    this.label = shape("text", { class: "sw-horizon-label" });
    this.others = shape("g");
    /** @type {Record<string, [number, number]>} rows at either edge, by the other methods */
    this.rows = {};
    /** @type {unknown} the scene that `rows` belongs to */
    this.scene = null;
    this.handles = ["Horizon, left end", "Horizon, right end"].map((label, i) => {
      const handle = shape(
        "g",
        { class: "sw-horizon-handle", tabindex: 0, role: "slider", "aria-label": label },
        shape("circle", { r: 8 }),
        shape("path", { d: "M-4 -3 L0 3 L4 -3 Z" }),
      );
      handle.addEventListener("keydown", (event) => this.onKey(event, /** @type {0 | 1} */ (i)));
      for (const end of ["keyup", "blur"]) handle.addEventListener(end, () => this.end());
      return handle;
    });
    this.node = shape(
      "g",
      { class: "sw-horizon-tool" },
      this.others,
      this.shadow,
      this.path,
      this.label,
      ...this.handles,
    );
  }

  /** Fetch the other methods' horizons, once per scene. */
  async refresh() {
    const { scene } = this.picture;
    if (this.hand.tool !== "horizon" || !scene || scene === this.scene) return;
    this.scene = scene;
    this.rows = {};
    try {
      const { result } = await this.channel.request("horizons");
      if (scene === this.scene) this.rows = result;
    } catch {
      // They are only for comparison: without a kernel, show none.
    }
    this.parts.draw();
  }

  /** The current line: dragged, set by the user, or detected. @returns {[Point, Point] | null} */
  current() {
    const { camera } = this.picture;
    if (this.line || !camera) return this.line;
    const columns = this.columns();
    const hint = /** @type {[Point, Point] | null} */ (this.state.values.horizon_hint);
    if (hint) return through(hint, columns);
    const [ux, uy, uz] = camera.up;
    return /** @type {[Point, Point]} */ (
      columns.map((x) => {
        const u = (x - 0.5) * camera.width;
        const row = camera.height / 2 - (ux * u + uz * camera.focal) / uy;
        return [x, row / camera.height];
      })
    );
  }

  /** Horizontal positions of the handles, both visible at any zoom. */
  columns() {
    const { x, width, stageWidth } = this.stage.rectangle();
    if (!width) return ENDS;
    const left = Math.max(0, -x / width);
    const right = Math.min(1, (stageWidth - x) / width);
    return ENDS.map((end) => left + end * (right - left));
  }

  /** @param {Point} place */
  begin(place) {
    this.line = this.current();
    this.moved = false;
    if (!this.line) return;
    const box = this.stage.rectangle();
    const [x, y] = this.stage.onOverlay(place);
    const reach = this.line.map((end) => {
      const at = this.onStage(end, box);
      return Math.hypot(at.x - x, at.y - y);
    });
    this.grip = reach[0] < GRAB ? 0 : reach[1] < GRAB ? 1 : "both";
    this.last = place;
    // A handle that waits at the edge jumps to the pointer with the first move.
    const held = this.grip === "both" ? mean(this.line) : this.line[this.grip];
    if (this.onStage(held, box).outside) this.last = [place[0], held[1]];
  }

  /** @param {Point} place @param {{ shiftKey: boolean }} event */
  move(place, event) {
    if (!this.line) return;
    const rise = place[1] - this.last[1];
    if (rise === 0 && !this.moved) return;
    this.last = place;
    this.shift(rise, event.shiftKey);
  }

  /** @param {number} rise fractions of the height @param {boolean} level */
  shift(rise, level) {
    if (!this.line) return;
    this.moved = true;
    const [left, right] = this.line;
    if (this.grip !== 1) left[1] = limit(left[1] + rise);
    if (this.grip !== 0) right[1] = limit(right[1] + rise);
    if (level) {
      const row = this.grip === "both" ? (left[1] + right[1]) / 2 : this.line[this.grip][1];
      left[1] = right[1] = row;
    }
    this.parts.draw();
  }

  end() {
    const { line } = this;
    this.line = null;
    // A click without a move sets nothing.
    if (!line || !this.moved) return;
    this.state.set({ horizon_hint: line.map(([x, y]) => [round(x), round(y)]) });
  }

  cancel() {
    this.line = null;
    this.parts.draw();
  }

  focus() {
    this.handles[0].focus({ preventScroll: true });
  }

  /** Return to the detected horizon. */
  reset() {
    this.line = null;
    this.state.set({ horizon_hint: null });
  }

  /**
   * @param {KeyboardEvent} event
   * @param {0 | 1} grip
   */
  onKey(event, grip) {
    if (event.key === "Home") {
      event.preventDefault();
      this.reset();
    }
    const step = { ArrowUp: -0.002, ArrowDown: 0.002 }[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    this.line ??= this.current();
    this.grip = grip;
    this.shift(step * (event.shiftKey ? 10 : 1), false);
  }

  draw() {
    const line = this.current();
    const shown = this.hand.tool === "horizon" && line;
    setAttributes(this.node, { visibility: shown ? "visible" : "hidden" });
    for (const handle of this.handles) setAttributes(handle, { tabindex: shown ? 0 : -1 });
    if (!shown) return;
    const box = this.stage.rectangle();
    const [a, b] = line.map((place) => this.stage.onOverlay(place));
    const slope = (b[1] - a[1]) / (b[0] - a[0]);
    for (const node of [this.shadow, this.path]) {
      setAttributes(node, {
        x1: box.x,
        y1: a[1] + slope * (box.x - a[0]),
        x2: box.x + box.width,
        y2: a[1] + slope * (box.x + box.width - a[0]),
      });
    }
    const { confidence = 0 } = this.picture.scene?.horizon ?? {};
    const given = this.line !== null || this.state.values.horizon_hint;
    this.node.classList.toggle("sw-guessed", !given && confidence < GUESSED);
    line.forEach((end, i) => {
      const { x, y, outside } = this.onStage(end, box);
      const handle = this.handles[i];
      handle.classList.toggle("sw-outside", outside !== 0);
      setAttributes(handle, {
        transform: `translate(${x} ${y})${outside < 0 ? " rotate(180)" : ""}`,
        "aria-valuenow": end[1].toFixed(3),
        "aria-valuetext": `${(100 * end[1]).toFixed(1)} % from the top`,
      });
    });
    this.drawLabel(line, box);
    this.drawOthers(box);
  }

  /**
   * Position of a handle: on its end of the line, or at the stage's edge toward it.
   *
   * @param {Point} end
   * @param {{ stageHeight: number }} box
   */
  onStage(end, box) {
    const [x, y] = this.stage.onOverlay(end);
    const held = Math.min(box.stageHeight - EDGE, Math.max(EDGE, y));
    return { x, y: held, outside: Math.sign(y - held) };
  }

  /** @param {[Point, Point]} line @param {ReturnType<import("../view/stage.js").Stage["rectangle"]>} box */
  drawLabel(line, box) {
    const { x, y } = this.onStage(mean(line), box);
    const above = y > 44;
    setAttributes(this.label, { x, y: above ? y - 9 : y + 20 });
    this.label.textContent = this.describe(line);
  }

  /** @param {[Point, Point]} line */
  describe([left, right]) {
    const { scene, camera } = this.picture;
    const row = (left[1] + right[1]) / 2;
    const drop = ((right[1] - left[1]) * (camera?.height ?? 1)) / (camera?.width ?? 1);
    const roll = (Math.atan(drop / (right[0] - left[0])) * 180) / Math.PI;
    const tilt =
      Math.abs(roll) < 0.05
        ? "level"
        : `${Math.abs(roll).toFixed(1)}° to the ${roll > 0 ? "right" : "left"}`;
    const out = row < 0 ? " · above the picture" : row > 1 ? " · below the picture" : "";
    if (this.line) return `${(100 * row).toFixed(1)} % · ${tilt}${out}`;
    if (this.state.values.horizon_hint) return `Set by hand · ${tilt}${out}`;
    const { confidence = 0 } = scene?.horizon ?? {};
    if (confidence < GUESSED) return `Guessed: drag it to the horizon${out}`;
    return `${confidence < UNCERTAIN ? "Found, uncertain" : "Found"} · ${tilt}${out}`;
  }

  /** @param {ReturnType<import("../view/stage.js").Stage["rectangle"]>} box */
  drawOthers(box) {
    const end = Math.min(box.stageWidth, box.x + box.width) - 6;
    const all = Object.entries(this.rows).map(([name, [left, right]]) => {
      const [y1, y2] = [box.y + left * box.height, box.y + right * box.height];
      const y = y1 + ((y2 - y1) * (end - box.x)) / box.width + LABEL;
      return { name: OTHERS[name] ?? name, y1, y2, y };
    });
    const rows = labelRows(
      all.map(({ y }) => y),
      LABEL,
    );
    const lines = all.map(({ name, y1, y2 }, i) =>
      shape(
        "g",
        { class: "sw-horizon-other" },
        shape("line", { x1: box.x, y1, x2: box.x + box.width, y2 }),
        text(name, end, rows[i]),
      ),
    );
    this.others.replaceChildren(...lines);
  }
}

/** @param {string} content @param {number} x @param {number} y */
function text(content, x, y) {
  const node = shape("text", { x, y, "text-anchor": "end" });
  node.textContent = content;
  return node;
}

/** @param {[Point, Point]} hint @param {number[]} columns @returns {[Point, Point]} the line at other columns */
function through([a, b], columns) {
  const slope = (b[1] - a[1]) / (b[0] - a[0]);
  return /** @type {[Point, Point]} */ (columns.map((x) => [x, a[1] + slope * (x - a[0])]));
}

/** @type {(line: [Point, Point]) => Point} */
const mean = ([a, b]) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
const limit = (/** @type {number} */ y) => Math.min(3, Math.max(-2, y));
const round = (/** @type {number} */ value) => Math.round(value * 1e5) / 1e5;
