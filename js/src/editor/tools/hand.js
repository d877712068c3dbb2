/** The selected tool, its brush, and the pointer that drags. */

/**
 * @typedef {import("../../host/types.js").Point} Point
 * @typedef {{
 *   node: SVGElement, draw: () => void, end: () => void, cancel: () => void,
 *   begin: (place: Point, event: PointerEvent) => void,
 *   move: (place: Point, event: PointerEvent) => void,
 *   hover?: (place: Point | null) => void,
 *   reset?: () => void,
 *   refresh?: () => void,
 *   focus?: () => void,
 *   spot?: () => { x: number, y: number },
 *   stays?: boolean,
 *   fine?: boolean,
 * }} Tool
 */

export class Hand {
  /** @param {Pick<import("../view/kernel.js").Kernel, "answers">} kernel */
  constructor(kernel) {
    this.kernel = kernel;
    /** @type {Record<string, Tool>} */
    this.tools = {};
    this.tool = "sun";
    this.brushRadius = 0.015;
    this.subject = "sky"; // what brush strokes mark
    /** @type {number | null} the pointer that drags */
    this.pointer = null;
    /** Cancels the pointer's gesture and releases it. */
    this.cancel = () => {};
    /** @type {() => void} called when a tool is selected */
    this.onTool = () => {};
    /** @type {() => void} called when the brush size changes */
    this.onBrush = () => {};
  }

  /** @param {string} tool */
  setTool(tool) {
    if (tool !== "sun" && !this.kernel.answers) return; // all other tools correct the analysis
    this.cancel();
    this.tool = tool;
    this.onTool();
  }

  /** Choose what brush strokes mark. @param {string} subject sky or water */
  setSubject(subject) {
    this.subject = subject;
    this.setTool(this.tool === "not_sky" ? "not_sky" : "sky");
  }

  /** @param {number} radius fraction of the longer side */
  setBrushRadius(radius) {
    this.brushRadius = Math.min(0.06, Math.max(0.003, radius));
    this.onBrush();
  }

  loaded() {
    this.tools[this.tool].refresh?.();
  }
}
