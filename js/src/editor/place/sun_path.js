/**
 * The sun's path over the day, drawn on the picture with the hours; the sun can be dragged along
 * it. Solid while the sun is up, dashed in twilight; the night is not drawn.
 */

import { clock as clockText, sunAt } from "../../geometry/day.js";
import { setAttributes, shape } from "../../ui/element.js";
import { KEY_STEP } from "../../ui/sun_shape.js";

/**
 * @typedef {import("../../host/types.js").Point} Point
 * @typedef {{ x: number, y: number, hours: number, up: number }} Step a point of the path in the
 *   overlay's CSS pixels
 */

const REACH = 12; // CSS pixels from the path within which a press grabs it
const TWILIGHT = -6; // degrees of elevation where the line ends
const FAR = 4; // picture widths beyond which the path is not drawn
const LABEL_ROOM = 46; // CSS pixels between labels
const KEY_MINUTES = 5;

export class SunPath {
  /**
   * @param {import("../types.js").Needs<"clock" | "hand" | "model" | "picture" | "stage">} needs
   */
  constructor({ clock, hand, model, picture, stage }) {
    this.clock = clock;
    this.hand = hand;
    this.model = model;
    this.picture = picture;
    this.stage = stage;
    this.shown = true; // the user's choice
    this.kept = false; // whether every drag of the sun follows the path
    /** @type {Step[][]} unbroken runs */
    this.runs = [];
    this.key = "";
    /** @type {import("../../geometry/camera.js").Camera | null} that the runs were projected with */
    this.camera = null;
    /** @type {{ run: number, at: number } | null} the drag's run and step */
    this.grip = null;
    const line = (/** @type {string} */ name) => shape("path", { class: name });
    this.shadow = line("sw-path-shadow");
    this.day = line("sw-path-day");
    this.twilight = line("sw-path-twilight");
    this.hit = line("sw-path-hit");
    this.marks = shape("g", { class: "sw-path-marks" });
    this.bead = shape("circle", { class: "sw-path-bead", r: 4.5 });
    this.ghostText = shape("text", { y: -12 });
    this.ghost = shape(
      "g",
      { class: "sw-path-ghost", visibility: "hidden" },
      shape("circle", { r: 3.5 }),
      this.ghostText,
    );
    this.node = shape(
      "g",
      { class: "sw-path", "aria-hidden": "true" },
      this.shadow,
      this.twilight,
      this.day,
      this.marks,
      this.bead,
      this.hit,
      this.ghost,
    );
    // Below the handles: a press grabs the sun first.
    stage.overlay.prepend(this.node);
  }

  draw() {
    const { place, path } = this.clock;
    const { camera } = this.picture;
    const seen = this.shown && path.length > 0 && place?.heading != null && camera;
    setAttributes(this.node, { visibility: seen ? "visible" : "hidden" });
    if (!seen || !place) {
      this.runs = [];
      this.key = "";
      return;
    }
    const box = this.stage.rectangle();
    const { x, y, width } = box;
    const key = JSON.stringify([x, y, width, this.model.get("_day").key, place.heading]);
    if (key !== this.key || this.camera !== camera) {
      this.key = key;
      this.camera = camera;
      this.lay(box);
    }
    const at = this.placeOf(this.clock.sun(), box);
    // The sun's handle would cover it.
    const alone = at && !this.clock.follows();
    setAttributes(this.bead, { visibility: alone ? "inherit" : "hidden", cx: at?.x, cy: at?.y });
  }

  /**
   * Project a sun position onto the overlay.
   *
   * @param {import("../../geometry/day.js").SunPlace | null} sun
   * @param {import("../../ui/stage.js").Box} box
   * @returns {{ x: number, y: number } | null} null behind the camera or far outside
   */
  placeOf(sun, box) {
    const { camera } = this.picture;
    const heading = this.clock.place?.heading ?? 0;
    const pixel = sun && camera?.pixel(sun.azimuth - heading, sun.apparent);
    if (!pixel || !camera) return null;
    const [across, down] = [pixel[0] / camera.width, pixel[1] / camera.height];
    if (Math.abs(across) > FAR || Math.abs(down) > FAR) return null;
    return { x: box.x + across * box.width, y: box.y + down * box.height };
  }

  /** Lay the path on the overlay. @param {import("../../ui/stage.js").Box} box */
  lay(box) {
    const { path } = this.clock;
    this.runs = [];
    /** @type {Step[]} */
    let run = [];
    for (const [hours, azimuth, apparent] of path) {
      const at = this.placeOf({ azimuth, apparent, true: 0 }, box);
      if (at && apparent > TWILIGHT) run.push({ ...at, hours, up: apparent });
      else if (run.length) {
        this.runs.push(run);
        run = [];
      }
    }
    if (run.length) this.runs.push(run);
    this.runs = this.runs.filter((one) => one.length > 1);
    const d = (/** @type {(step: Step) => boolean} */ wanted) =>
      this.runs.map((one) => lineThrough(one, wanted)).join("");
    const all = d(() => true);
    setAttributes(this.shadow, { d: all });
    setAttributes(this.hit, { d: all });
    setAttributes(this.day, { d: d(({ up }) => up >= 0) });
    setAttributes(this.twilight, { d: d(({ up }) => up < 0) });
    this.marks.replaceChildren(...this.hourMarks(box));
  }

  /** Mark the full hours on the path, with room between their labels. @param {import("../../ui/stage.js").Box} box */
  hourMarks(box) {
    const nodes = [];
    const middle = [box.x + box.width / 2, box.y + box.height / 2];
    for (const run of this.runs) {
      /** @type {{ x: number, y: number } | null} */
      let last = null;
      for (let hour = Math.ceil(run[0].hours); hour <= run[run.length - 1].hours; hour++) {
        const at = this.placeOf(sunAt(this.clock.path, hour), box);
        const ahead = this.placeOf(sunAt(this.clock.path, hour + 0.05), box);
        if (!at || !ahead) continue;
        nodes.push(shape("circle", { class: "sw-path-hour", r: 2.4, cx: at.x, cy: at.y }));
        if (last && Math.hypot(at.x - last.x, at.y - last.y) < LABEL_ROOM) continue;
        last = at;
        // On the outer side of the line: the arch encloses the picture's sky.
        const length = Math.hypot(ahead.x - at.x, ahead.y - at.y) || 1;
        let [nx, ny] = [(ahead.y - at.y) / length, -(ahead.x - at.x) / length];
        if (nx * (at.x - middle[0]) + ny * (at.y - middle[1] - box.height) < 0)
          [nx, ny] = [-nx, -ny];
        const label = shape("text", { x: at.x + nx * 17, y: at.y + ny * 13 + 4 });
        label.textContent = clockText(((hour % 24) + 24) % 24);
        nodes.push(label);
      }
    }
    return nodes;
  }

  /** @param {Point} place of the picture @returns {{ x: number, y: number }} */
  onOverlay(place) {
    const [x, y] = this.stage.onOverlay(place);
    return { x, y };
  }

  /**
   * Find the step of the whole path nearest to a point.
   *
   * @param {{ x: number, y: number }} point
   */
  nearest(point) {
    let best = { run: 0, at: 0, far: Number.POSITIVE_INFINITY };
    for (const [run, steps] of this.runs.entries()) {
      for (let at = 0; at + 1 < steps.length; at++) {
        const { far } = project(steps[at], steps[at + 1], point);
        if (far < best.far) best = { run, at, far };
      }
    }
    return best;
  }

  /** Whether a drag that begins at a place follows the path. @param {Point} place @param {boolean} onSun */
  takes(place, onSun) {
    const near = this.nearest(this.onOverlay(place));
    const takes =
      near.far < Number.POSITIVE_INFINITY && (this.kept || (!onSun && near.far < REACH));
    this.grip = takes ? near : null;
    return takes;
  }

  /**
   * Move along the path to its nearest point, step by step from the drag's position: the nearest
   * point overall could jump where the path meets itself.
   *
   * @param {Point} place
   */
  follow(place) {
    const { grip } = this;
    const steps = grip && this.runs[grip.run];
    if (!steps) return;
    const point = this.onOverlay(place);
    const reach = (/** @type {number} */ at) => project(steps[at], steps[at + 1], point).far;
    let at = Math.min(grip.at, steps.length - 2);
    for (const step of [-1, 1]) {
      while (at + step >= 0 && at + step < steps.length - 1 && reach(at + step) < reach(at))
        at += step;
    }
    grip.at = at;
    const [from, to] = [steps[at], steps[at + 1]];
    const { share } = project(from, to, point);
    this.clock.moveTo(from.hours + share * (to.hours - from.hours));
  }

  /** Handle an arrow key while the sun is kept on its path: five minutes. @param {Point} step */
  step([across, up]) {
    if (!this.kept || !this.runs.length) return false;
    // Right and up are later; Shift moves ten times as far, as for a free sun.
    this.clock.moveTo(this.clock.hours + ((across || up) / KEY_STEP) * (KEY_MINUTES / 60));
    return true;
  }

  /** Show the time under the pointer when it is on the path. @param {Point | null} place */
  point(place) {
    const idle =
      place && this.hand.pointer === null && this.hand.tool === "sun" && this.runs.length;
    const near = idle ? this.nearest(this.onOverlay(place)) : null;
    const on = near !== null && near.far < REACH;
    setAttributes(this.ghost, { visibility: on ? "inherit" : "hidden" });
    if (!on || !place) return;
    const [from, to] = this.runs[near.run].slice(near.at, near.at + 2);
    const { share } = project(from, to, this.onOverlay(place));
    const mix = (/** @type {"x" | "y" | "hours"} */ name) =>
      from[name] + share * (to[name] - from[name]);
    setAttributes(this.ghost, { transform: `translate(${mix("x")} ${mix("y")})` });
    const hours = mix("hours");
    this.ghostText.textContent = clockText(hours - 24 * Math.floor(hours / 24));
  }
}

/** SVG path data through the wanted steps and on to their neighbors. @param {Step[]} run @param {(step: Step) => boolean} wanted */
function lineThrough(run, wanted) {
  let text = "";
  let open = false;
  for (const [i, step] of run.entries()) {
    const drawn = wanted(step) || (i > 0 && wanted(run[i - 1]));
    if (drawn && !open && i > 0 && !wanted(step)) continue;
    if (drawn) text += `${open ? "L" : "M"}${step.x.toFixed(1)} ${step.y.toFixed(1)}`;
    open = drawn;
  }
  return text;
}

/**
 * Project a point onto a line segment.
 *
 * @param {Step} from
 * @param {Step} to
 * @param {{ x: number, y: number }} point
 * @returns {{ share: number, far: number }} 0 at `from`, 1 at `to`; distance in CSS pixels
 */
function project(from, to, { x, y }) {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const squared = dx * dx + dy * dy || 1e-12;
  const share = Math.min(1, Math.max(0, ((x - from.x) * dx + (y - from.y) * dy) / squared));
  return { share, far: Math.hypot(x - from.x - share * dx, y - from.y - share * dy) };
}
