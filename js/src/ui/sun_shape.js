/** The sun's handle in both widgets: rings, an arrow at the stage's edge, and key steps. */

import { setAttributes, shape } from "./element.js";

/** @typedef {{ x: number, y: number, outside: boolean, angle: number }} Spot */

export const GRAB = 26; // CSS pixels from the sun within which a press grabs it without a jump
export const EDGE = 26; // CSS pixels from the stage's edge at which an outside sun's handle waits
export const KEY_STEP = 0.5; // degrees
/** @type {Record<string, import("../host/types.js").Point>} */
const DIRECTIONS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export class SunShape {
  /** @param {SVGElement[]} marks shapes in its middle */
  constructor(...marks) {
    const ring = (/** @type {string} */ name, /** @type {number} */ r) =>
      shape("circle", { class: name, r });
    this.arrow = shape("path", { class: "sw-sun-arrow", d: "M15 -6 L24 0 L15 6 Z" });
    this.node = shape(
      "g",
      { class: "sw-sun", tabindex: 0, role: "slider", "aria-label": "Sun" },
      ring("sw-sun-halo", 15),
      ring("sw-sun-ring", 11),
      ...marks,
      this.arrow,
    );
  }

  /**
   * @param {Spot} spot
   * @param {import("../host/types.js").Point} sun azimuth and elevation in degrees
   * @param {{ minimum: number, maximum: number }} bounds of the elevation
   */
  show({ x, y, outside, angle }, [azimuth, elevation], { minimum, maximum }) {
    setAttributes(this.node, {
      transform: `translate(${x} ${y})`,
      "aria-valuemin": minimum,
      "aria-valuemax": maximum,
      "aria-valuenow": elevation.toFixed(1),
      "aria-valuetext": `azimuth ${azimuth.toFixed(1)}°, elevation ${elevation.toFixed(1)}°`,
    });
    setAttributes(this.arrow, {
      visibility: outside ? "visible" : "hidden",
      transform: `rotate(${angle})`,
    });
  }
}

/**
 * Return the handle's position on the stage: at the sun, or at the stage's edge toward it.
 *
 * @param {import("./stage.js").Box} box
 * @param {number} dx CSS pixels from the picture's middle to the sun
 * @param {number} dy
 * @param {number} [edge]
 * @returns {Spot}
 */
export function spotOnStage(box, dx, dy, edge = EDGE) {
  // Toward the sun from the stage's middle: a zoomed picture's middle may not be visible.
  const [cx, cy] = [box.stageWidth / 2, box.stageHeight / 2];
  const [x, y] = [box.x + box.width / 2 + dx - cx, box.y + box.height / 2 + dy - cy];
  const share = Math.min(1, (cx - edge) / Math.abs(x || 1e-9), (cy - edge) / Math.abs(y || 1e-9));
  return {
    x: cx + x * share,
    y: cy + y * share,
    outside: share < 1,
    angle: (Math.atan2(y, x) * 180) / Math.PI,
  };
}

/**
 * Return an arrow key's step of the sun in degrees; null for any other key, which is not handled.
 *
 * @param {KeyboardEvent} event
 * @returns {import("../host/types.js").Point | null}
 */
export function keyStep(event) {
  const direction = DIRECTIONS[event.key];
  if (!direction || event.ctrlKey || event.metaKey) return null;
  event.preventDefault();
  event.stopPropagation();
  const step = KEY_STEP * (event.shiftKey ? 10 : event.altKey ? 0.2 : 1);
  return [direction[0] * step, direction[1] * step];
}
