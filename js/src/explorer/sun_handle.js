/** The sun's handle on the sky: drag it, also below the horizon, or move it with the arrow keys. */

import { setAttributes, shape } from "../controls/element.js";
import { turned } from "./day.js";

/** @typedef {import("../types.js").Point} Point */

export const GRAB = 26; // CSS pixels round the sun that take hold of it
// CSS pixels from the stage's edge at which a sun outside it waits; round the dome there is room
// for all of twilight.
const EDGE = 26;
const DOME_EDGE = 12;
const KEY_STEP = 0.5; // degrees

export class SunHandle {
  /** @param {import("./view.js").View} view */
  constructor(view) {
    this.view = view;
    const ring = (/** @type {string} */ name, /** @type {number} */ r) =>
      shape("circle", { class: name, r });
    this.arrow = shape("path", { class: "sw-sun-arrow", d: "M15 -6 L24 0 L15 6 Z" });
    this.node = shape(
      "g",
      { class: "sw-sun", tabindex: 0, role: "slider", "aria-label": "Sun" },
      ring("sw-sun-halo", 15),
      ring("sw-sun-ring", 11),
      this.arrow,
    );
    this.node.addEventListener("keydown", (event) => this.onKey(event));
    for (const end of ["keyup", "blur"]) {
      this.node.addEventListener(end, () => view.state.commit());
    }
  }

  /** @param {KeyboardEvent} event */
  onKey(event) {
    const direction = {
      ArrowLeft: [-1, 0],
      ArrowRight: [1, 0],
      ArrowUp: [0, 1],
      ArrowDown: [0, -1],
    }[event.key];
    if (!direction || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    // On a dome that looks up, east is to the left.
    const side = this.view.state.values.projection === "dome" ? -1 : 1;
    const step = KEY_STEP * (event.shiftKey ? 10 : event.altKey ? 0.2 : 1);
    const [azimuth, elevation] = this.view.sun();
    this.view.state.begin();
    this.view.moveSun(azimuth + side * direction[0] * step, elevation + direction[1] * step);
  }

  draw() {
    const { view } = this;
    const [azimuth, elevation] = view.sun();
    const box = view.stage.rectangle();
    const { x, y, outside, angle } = this.onStage(azimuth, elevation, box);
    const { minimum, maximum } = view.parameter("sun_elevation");
    setAttributes(this.node, {
      transform: `translate(${x} ${y})`,
      "aria-valuemin": minimum,
      "aria-valuemax": maximum,
      "aria-valuenow": elevation.toFixed(1),
      "aria-valuetext": `azimuth ${turned(azimuth).toFixed(1)}°, elevation ${elevation.toFixed(1)}°`,
    });
    setAttributes(this.arrow, {
      visibility: outside ? "visible" : "hidden",
      transform: `rotate(${angle})`,
    });
  }

  /**
   * @param {number} azimuth
   * @param {number} elevation
   * @param {ReturnType<import("./stage.js").SkyStage["rectangle"]>} box
   */
  onStage(azimuth, elevation, box) {
    const [cx, cy] = [box.x + box.width / 2, box.y + box.height / 2];
    const place = this.view.placeOf([azimuth, elevation]);
    const [dx, dy] = place
      ? [box.x + place[0] - cx, box.y + place[1] - cy]
      : // Behind the camera: the side to turn to.
        [turned(azimuth - Number(this.view.state.values.view_azimuth)) < 0 ? -1e6 : 1e6, 0];
    const edge = this.view.state.values.projection === "dome" ? DOME_EDGE : EDGE;
    const roomX = box.stageWidth / 2 - edge;
    const roomY = dy > 0 ? box.stageHeight - edge - cy : cy - edge;
    const share = Math.min(1, roomX / Math.abs(dx || 1e-9), roomY / Math.abs(dy || 1e-9));
    return {
      x: cx + dx * share,
      y: cy + dy * share,
      outside: share < 1,
      angle: (Math.atan2(dy, dx) * 180) / Math.PI,
    };
  }
}
