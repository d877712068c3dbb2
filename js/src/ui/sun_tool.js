/**
 * The sun's handle: drag it anywhere, even out of the picture, or move it with the arrow keys.
 *
 * Outside the stage the handle waits at the edge with an arrow toward the sun.
 */

import { parameterOf } from "../edit/parameter.js";
import { setAttributes, shape } from "./element.js";
import { GRAB, keyStep, SunShape, spotOnStage } from "./sun_shape.js";

/**
 * @typedef {import("../edit/state.js").EditState} EditState
 * @typedef {import("../host/types.js").Point} Point
 * @typedef {{
 *   picture: {
 *     camera: import("../geometry/camera.js").Camera | null,
 *     scene: import("../host/types.js").Scene | null,
 *     value: (name: string) => number,
 *   },
 *   stage: Pick<import("./stage.js").PictureStage, "rectangle">,
 *   state: Pick<EditState, "parameters" | "begin" | "commit" | "cancel" | "set">,
 * }} Needs
 * @typedef {{
 *   takes: (place: Point, onSun: boolean) => boolean,
 *   follow: (place: Point) => void,
 *   step: (step: Point) => boolean,
 * }} SunTrack a path that a drag follows if `takes` accepts it; `step` handles an arrow key
 */

export class SunTool {
  /** @param {Needs} needs */
  constructor({ picture, stage, state }) {
    this.picture = picture;
    this.stage = stage;
    this.state = state;
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
      this.handle.addEventListener(end, () => this.state.commit());
    }
  }

  /** @param {Point} place @param {PointerEvent} event */
  begin(place, event) {
    const sun = this.place();
    const box = this.stage.rectangle();
    this.offset = [0, 0];
    let near = false;
    if (sun) {
      const [dx, dy] = [place[0] - sun[0], place[1] - sun[1]];
      near = Math.hypot(dx * box.width, dy * box.height) < GRAB;
      if (near) this.offset = [dx, dy];
    }
    this.tracked = this.track?.takes(place, near) ?? false;
    this.focus();
    // A press on the sun grabs it without moving it.
    if (!near) this.move(place, event);
  }

  /** @param {Point} place @param {PointerEvent} [_event] */
  move(place, _event) {
    const { camera } = this.picture;
    if (!camera) return;
    // Losing the focus ends a gesture; a drag that continues is a new one.
    this.state.begin();
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
    this.state.commit();
  }

  focus() {
    this.handle.focus({ preventScroll: true });
  }

  cancel() {
    this.state.cancel();
  }

  /**
   * @param {number} azimuth degrees
   * @param {number} elevation degrees
   */
  moveTo(azimuth, elevation) {
    this.state.set(this.edit(azimuth, elevation));
  }

  /** Return the edit's values for a direction. @param {number} azimuth @param {number} elevation */
  edit(azimuth, elevation) {
    const round = (/** @type {string} */ name, /** @type {number} */ value) => {
      const p = parameterOf(this.state.parameters, name);
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
      this.state.set({ sun_azimuth: null, sun_elevation: null });
    }
    const step = keyStep(event);
    if (!step) return;
    this.state.begin();
    if (this.track?.step(step)) return;
    const [azimuth, elevation] = this.direction();
    const { sun_azimuth, sun_elevation } = this.edit(azimuth + step[0], elevation + step[1]);
    // The coordinate that it does not move stays automatic.
    this.state.set(step[0] ? { sun_azimuth } : { sun_elevation });
  }

  /** The sun's azimuth and elevation in degrees. @returns {Point} */
  direction() {
    return [this.picture.value("sun_azimuth"), this.picture.value("sun_elevation")];
  }

  /** The sun's place on the picture, or null behind the camera. @returns {Point | null} */
  place() {
    return this.placeOf(...this.direction());
  }

  /**
   * @param {number} azimuth
   * @param {number} elevation
   * @returns {Point | null}
   */
  placeOf(azimuth, elevation) {
    const { camera } = this.picture;
    const pixel = camera?.pixel(azimuth, elevation);
    return camera && pixel ? [pixel[0] / camera.width, pixel[1] / camera.height] : null;
  }

  /** The handle's position on the stage. */
  spot() {
    const [azimuth, elevation] = this.direction();
    return this.onStage(azimuth, elevation, this.stage.rectangle());
  }

  draw() {
    const { camera, scene } = this.picture;
    setAttributes(this.node, { visibility: camera && scene ? "visible" : "hidden" });
    if (!camera || !scene) return;
    const [azimuth, elevation] = this.direction();
    const box = this.stage.rectangle();
    const at = this.onStage(azimuth, elevation, box);
    this.shape.show(at, [azimuth, elevation], parameterOf(this.state.parameters, "sun_elevation"));

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
   * Return the handle's position on the stage: at the sun, or at the edge toward it.
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
      const [bx, by] = this.picture.camera?.bearing(azimuth, elevation) ?? [0, -1];
      [dx, dy] = [bx * 1e6, by * 1e6];
    }
    return spotOnStage(box, dx, dy);
  }
}
