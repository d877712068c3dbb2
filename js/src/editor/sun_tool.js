/**
 * The sun's handle: drag it anywhere, also out of the picture, or move it with the arrow keys.
 *
 * Outside the stage the handle waits at the edge with an arrow towards the sun.
 */

import { setAttributes, shape } from "../controls/element.js";

/**
 * @typedef {import("../types.js").Point} Point
 * @typedef {import("./view.js").View} View
 */

const GRAB = 26; // CSS pixels round the handle that take hold of it without a jump
const EDGE = 26; // CSS pixels from the stage's edge at which an outside sun's handle waits
const KEY_STEP = 0.5; // degrees

export class SunTool {
  /** @param {View} view */
  constructor(view) {
    this.view = view;
    /** @type {Point} offset of the grip from the sun, in fractions of the picture */
    this.offset = [0, 0];
    const ring = (/** @type {string} */ name, /** @type {number} */ r) =>
      shape("circle", { class: name, r });
    this.arrow = shape("path", { class: "sw-sun-arrow", d: "M15 -6 L24 0 L15 6 Z" });
    this.handle = shape(
      "g",
      { class: "sw-sun", tabindex: 0, role: "slider", "aria-label": "Sun" },
      ring("sw-sun-halo", 15),
      ring("sw-sun-ring", 11),
      ring("sw-sun-core", 3),
      this.arrow,
    );
    this.origin = shape(
      "g",
      { class: "sw-sun-origin" },
      shape("circle", { r: 9 }),
      shape("path", { d: "M-3 0H3M0 -3V3" }),
    );
    this.line = shape("line", { class: "sw-sun-trail" });
    this.node = shape("g", { class: "sw-sun-tool" }, this.line, this.origin, this.handle);
    this.handle.addEventListener("keydown", (event) => this.onKey(event));
    for (const end of ["keyup", "blur"]) {
      this.handle.addEventListener(end, () => this.view.state.commit());
    }
  }

  /** @param {Point} place @param {PointerEvent} event */
  begin(place, event) {
    const sun = this.place();
    const box = this.view.stage.rectangle();
    this.offset = [0, 0];
    if (sun) {
      const [dx, dy] = [place[0] - sun[0], place[1] - sun[1]];
      const near = Math.hypot(dx * box.width, dy * box.height) < GRAB;
      if (near) this.offset = [dx, dy];
    }
    this.handle.focus({ preventScroll: true });
    this.move(place, event);
  }

  /** @param {Point} place @param {PointerEvent} [_event] */
  move(place, _event) {
    const { camera } = this.view;
    if (!camera) return;
    // Losing the focus ends a gesture; a drag that goes on is the next one.
    this.view.state.begin();
    const [azimuth, elevation] = camera.angles(
      (place[0] - this.offset[0]) * camera.width,
      (place[1] - this.offset[1]) * camera.height,
    );
    this.moveTo(azimuth, elevation);
  }

  end() {
    this.view.state.commit();
  }

  cancel() {
    this.view.state.cancel();
  }

  /**
   * @param {number} azimuth degrees
   * @param {number} elevation degrees
   */
  moveTo(azimuth, elevation) {
    const round = (/** @type {string} */ name, /** @type {number} */ value) => {
      const p = this.view.parameter(name);
      return Math.round(Math.min(p.maximum, Math.max(p.minimum, value)) * 1e4) / 1e4;
    };
    const turned = ((((azimuth + 180) % 360) + 360) % 360) - 180;
    this.view.state.set({
      sun_azimuth: round("sun_azimuth", turned),
      sun_elevation: round("sun_elevation", elevation),
    });
  }

  /** @param {KeyboardEvent} event */
  onKey(event) {
    const direction = {
      ArrowLeft: [-1, 0],
      ArrowRight: [1, 0],
      ArrowUp: [0, 1],
      ArrowDown: [0, -1],
    }[event.key];
    if (event.key === "Home") {
      event.preventDefault();
      this.view.state.set({ sun_azimuth: null, sun_elevation: null });
    }
    if (!direction || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    const step = KEY_STEP * (event.shiftKey ? 10 : event.altKey ? 0.2 : 1);
    this.view.state.begin();
    this.moveTo(
      this.view.value("sun_azimuth") + direction[0] * step,
      this.view.value("sun_elevation") + direction[1] * step,
    );
  }

  /** Where the sun is on the picture, or null behind the camera. @returns {Point | null} */
  place() {
    return this.placeOf(this.view.value("sun_azimuth"), this.view.value("sun_elevation"));
  }

  /**
   * @param {number} azimuth
   * @param {number} elevation
   * @returns {Point | null}
   */
  placeOf(azimuth, elevation) {
    const { camera } = this.view;
    const pixel = camera?.pixel(azimuth, elevation);
    return camera && pixel ? [pixel[0] / camera.width, pixel[1] / camera.height] : null;
  }

  draw() {
    const { camera, stage, scene } = this.view;
    setAttributes(this.node, { visibility: camera && scene ? "visible" : "hidden" });
    if (!camera || !scene) return;
    const [azimuth, elevation] = [this.view.value("sun_azimuth"), this.view.value("sun_elevation")];
    const box = stage.rectangle();
    const at = this.onStage(azimuth, elevation, box);
    setAttributes(this.handle, {
      transform: `translate(${at.x} ${at.y})`,
      "aria-valuemin": this.view.parameter("sun_elevation").minimum,
      "aria-valuemax": this.view.parameter("sun_elevation").maximum,
      "aria-valuenow": elevation.toFixed(1),
      "aria-valuetext": `azimuth ${azimuth.toFixed(1)}°, elevation ${elevation.toFixed(1)}°`,
    });
    setAttributes(this.arrow, {
      visibility: at.outside ? "visible" : "hidden",
      transform: `rotate(${at.angle})`,
    });

    const own = this.onStage(scene.automatic.sun_azimuth, scene.automatic.sun_elevation, box);
    const apart = Math.hypot(at.x - own.x, at.y - own.y);
    const shown = apart > 14 && !own.outside ? "visible" : "hidden";
    setAttributes(this.origin, { transform: `translate(${own.x} ${own.y})`, visibility: shown });
    setAttributes(this.line, {
      x1: own.x,
      y1: own.y,
      x2: at.x,
      y2: at.y,
      visibility: apart > 14 && !own.outside ? "visible" : "hidden",
    });
  }

  /**
   * Where the handle stands on the stage: at the sun, or at the edge towards it.
   *
   * @param {number} azimuth
   * @param {number} elevation
   * @param {ReturnType<import("./stage.js").Stage["rectangle"]>} box
   */
  onStage(azimuth, elevation, box) {
    const place = this.placeOf(azimuth, elevation);
    const [cx, cy] = [box.x + box.width / 2, box.y + box.height / 2];
    let [dx, dy] = [0, 0];
    if (place) {
      [dx, dy] = [(place[0] - 0.5) * box.width, (place[1] - 0.5) * box.height];
    } else {
      const [bx, by] = this.view.camera?.bearing(azimuth, elevation) ?? [0, -1];
      [dx, dy] = [bx * 1e6, by * 1e6];
    }
    // Shrink the way from the centre until it ends on the stage.
    const roomX = dx > 0 ? box.stageWidth - EDGE - cx : cx - EDGE;
    const roomY = dy > 0 ? box.stageHeight - EDGE - cy : cy - EDGE;
    const share = Math.min(1, roomX / Math.abs(dx || 1e-9), roomY / Math.abs(dy || 1e-9));
    return {
      x: cx + dx * share,
      y: cy + dy * share,
      outside: share < 1,
      angle: (Math.atan2(dy, dx) * 180) / Math.PI,
    };
  }
}
