/**
 * The sun's handle: drag it anywhere, also out of the picture, or move it with the arrow keys.
 *
 * Outside the stage the handle waits at the edge with an arrow towards the sun.
 */

import { setAttributes, shape } from "./element.js";
import { GRAB, keyStep, SunShape, spotOnStage } from "./sun_shape.js";

/**
 * @typedef {import("../host/types.js").Point} Point
 * @typedef {{
 *   camera: import("../geometry/camera.js").Camera | null,
 *   scene: import("../host/types.js").Scene | null,
 *   value: (name: string) => number,
 *   parameter: (name: string) => import("../host/types.js").Parameter,
 *   stage: Pick<import("./stage.js").PictureStage, "rectangle">,
 *   state: Pick<import("../edit/state.js").EditState, "begin" | "commit" | "cancel" | "set">,
 * }} SunHost what the handle needs of a view
 * @typedef {{
 *   takes: (place: Point, onSun: boolean) => boolean,
 *   follow: (place: Point) => void,
 *   step: (step: Point) => boolean,
 * }} SunTrack a path that a drag follows where it `takes` it; `step` answers an arrow key
 */

export class SunTool {
  /** @param {SunHost} view */
  constructor(view) {
    this.view = view;
    /** @type {Point} offset of the grip from the sun, in fractions of the picture */
    this.offset = [0, 0];
    /** @type {SunTrack | null} */
    this.track = null;
    this.tracked = false; // whether the drag follows it
    this.shape = new SunShape(shape("circle", { class: "sw-sun-core", r: 3 }));
    this.handle = this.shape.node;
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
    let near = false;
    if (sun) {
      const [dx, dy] = [place[0] - sun[0], place[1] - sun[1]];
      near = Math.hypot(dx * box.width, dy * box.height) < GRAB;
      if (near) this.offset = [dx, dy];
    }
    this.tracked = this.track?.takes(place, near) ?? false;
    this.focus();
    // A press on the sun takes hold of it, and by itself moves nothing.
    if (!near) this.move(place, event);
  }

  /** @param {Point} place @param {PointerEvent} [_event] */
  move(place, _event) {
    const { camera } = this.view;
    if (!camera) return;
    // Losing the focus ends a gesture; a drag that goes on is the next one.
    this.view.state.begin();
    if (this.tracked) {
      this.track?.follow([place[0] - this.offset[0], place[1] - this.offset[1]]);
      return;
    }
    const [azimuth, elevation] = camera.angles(
      (place[0] - this.offset[0]) * camera.width,
      (place[1] - this.offset[1]) * camera.height,
    );
    this.moveTo(azimuth, elevation);
  }

  end() {
    this.view.state.commit();
  }

  focus() {
    this.handle.focus({ preventScroll: true });
  }

  cancel() {
    this.view.state.cancel();
  }

  /**
   * @param {number} azimuth degrees
   * @param {number} elevation degrees
   */
  moveTo(azimuth, elevation) {
    this.view.state.set(this.edit(azimuth, elevation));
  }

  /** A direction as the edit holds it. @param {number} azimuth @param {number} elevation */
  edit(azimuth, elevation) {
    const round = (/** @type {string} */ name, /** @type {number} */ value) => {
      const p = this.view.parameter(name);
      return Math.round(Math.min(p.maximum, Math.max(p.minimum, value)) * 1e4) / 1e4;
    };
    const turned = ((((azimuth + 180) % 360) + 360) % 360) - 180;
    return {
      sun_azimuth: round("sun_azimuth", turned),
      sun_elevation: round("sun_elevation", elevation),
    };
  }

  /** @param {KeyboardEvent} event */
  onKey(event) {
    if (event.key === "Home") {
      event.preventDefault();
      this.view.state.set({ sun_azimuth: null, sun_elevation: null });
    }
    const step = keyStep(event);
    if (!step) return;
    this.view.state.begin();
    if (this.track?.step(step)) return;
    const { sun_azimuth, sun_elevation } = this.edit(
      this.view.value("sun_azimuth") + step[0],
      this.view.value("sun_elevation") + step[1],
    );
    // What it does not move stays the photo's own.
    this.view.state.set(step[0] ? { sun_azimuth } : { sun_elevation });
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

  /** Where the handle stands on the stage. */
  spot() {
    const [azimuth, elevation] = [this.view.value("sun_azimuth"), this.view.value("sun_elevation")];
    return this.onStage(azimuth, elevation, this.view.stage.rectangle());
  }

  draw() {
    const { camera, stage, scene } = this.view;
    setAttributes(this.node, { visibility: camera && scene ? "visible" : "hidden" });
    if (!camera || !scene) return;
    const [azimuth, elevation] = [this.view.value("sun_azimuth"), this.view.value("sun_elevation")];
    const box = stage.rectangle();
    const at = this.onStage(azimuth, elevation, box);
    this.shape.show(at, [azimuth, elevation], this.view.parameter("sun_elevation"));

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
   * @param {import("./stage.js").Box} box
   */
  onStage(azimuth, elevation, box) {
    const place = this.placeOf(azimuth, elevation);
    let [dx, dy] = [0, 0];
    if (place) {
      [dx, dy] = [(place[0] - 0.5) * box.width, (place[1] - 0.5) * box.height];
    } else {
      const [bx, by] = this.view.camera?.bearing(azimuth, elevation) ?? [0, -1];
      [dx, dy] = [bx * 1e6, by * 1e6];
    }
    return spotOnStage(box, dx, dy);
  }
}
