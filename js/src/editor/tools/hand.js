/** What the hand holds: the chosen tool, its brush, and the pointer that drags. */

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
    this.subject = "sky"; // what brush strokes are about
    /** @type {number | null} the pointer that drags */
    this.pointer = null;
    /** Drops what the pointer has begun, and lets it go. */
    this.cancel = () => {};
    /** @type {() => void} called when a tool was chosen */
    this.onTool = () => {};
    /** @type {() => void} called when the brush has another size */
    this.onBrush = () => {};
  }

  /** @param {string} tool */
  setTool(tool) {
    if (tool !== "sun" && !this.kernel.answers) return; // all others correct the analysis
    this.cancel();
    this.tool = tool;
    this.onTool();
  }

  /** What brush strokes are about from now on. @param {string} subject sky or water */
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
