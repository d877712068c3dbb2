/** Lines and letters over the sky: horizon, elevations, compass, and the seam of two models. */

import { setAttributes, shape } from "../ui/element.js";

/** @typedef {import("../host/types.js").Point} Point */

const COMPASS = [
  ["N", 0],
  ["E", 90],
  ["S", 180],
  ["W", -90],
];
const ELEVATIONS = [0, 30, 60];
const STEP = 2; // degrees between points of a line

/** Short names of the models, for labels on the picture. @type {Record<string, string>} */
export const MODEL_LABELS = {
  multiple: "All orders",
  single: "Single scattering",
  bruneton: "Bruneton",
  reference: "Path tracing",
};

export class Guides {
  /** @param {import("./types.js").Needs<"id" | "placeOf" | "stage" | "state" | "tables">} view */
  constructor(view) {
    this.view = view;
    this.node = shape("g", { class: "sw-guides", "aria-hidden": "true" });
    this.lines = shape("g");
    this.spot = shape("circle", { class: "sw-spot", r: 6, visibility: "hidden" });
    this.node.append(this.lines, this.spot);
    this.key = "";
  }

  /** Mark the direction that a plot highlights. @param {Point | null} direction */
  point(direction) {
    const place = direction && this.view.placeOf(direction);
    const box = this.view.stage.rectangle();
    const shown = place && inside(place, box);
    setAttributes(this.spot, {
      visibility: shown ? "visible" : "hidden",
      ...(shown ? { cx: box.x + place[0], cy: box.y + place[1] } : {}),
    });
  }

  draw() {
    const { view } = this;
    const box = view.stage.rectangle();
    const { projection, view_azimuth, view_elevation, fov, model, compare } = view.state.values;
    const looks = [projection, view_azimuth, view_elevation, fov, model, compare];
    const key = JSON.stringify([box, looks, view.tables]);
    if (key === this.key) return;
    this.key = key;
    const clip = shape("clipPath", { id: `${view.id}-sky` });
    clip.append(shape("rect", { x: 0, y: 0, width: box.width, height: box.height }));
    const lines = shape("g", {
      "clip-path": projection === "dome" ? null : `url(#${view.id}-sky)`,
    });
    const node = shape("g", { transform: `translate(${box.x} ${box.y})` }, clip, lines);
    for (const elevation of ELEVATIONS) {
      const path = this.line((i) => [i * STEP - 180, elevation], 360 / STEP);
      const name = elevation ? "sw-guide" : "sw-guide sw-guide-horizon";
      lines.append(shape("path", { d: path, class: `${name} sw-guide-shadow` }));
      lines.append(shape("path", { d: path, class: name }));
    }
    for (const [letter, azimuth] of COMPASS)
      this.letter(node, String(letter), Number(azimuth), box);
    for (const elevation of ELEVATIONS.slice(1)) this.number(node, elevation, box);
    if (compare !== "none") this.seam(node, box, String(model), String(compare));
    this.lines.replaceChildren(node);
  }

  /** @type {(at: (i: number) => Point, count: number) => string} */
  line(at, count) {
    const { width } = this.view.stage.rectangle();
    let path = "";
    /** @type {Point | null} */
    let last = null;
    for (let i = 0; i <= count; i++) {
      const place = this.view.placeOf(at(i));
      // Break the line at the edge of a panorama and behind the camera.
      const joined =
        place && last && Math.hypot(place[0] - last[0], place[1] - last[1]) < width / 2;
      if (place) path += `${joined ? "L" : "M"}${place[0].toFixed(1)} ${place[1].toFixed(1)}`;
      last = place;
    }
    return path;
  }

  /** @type {(node: SVGElement, letter: string, azimuth: number, box: { width: number, height: number }) => void} */
  letter(node, letter, azimuth, box) {
    const dome = this.view.state.values.projection === "dome";
    const place = this.view.placeOf([azimuth, dome ? -5 : 0]);
    if (!place || (!dome && !inside(place, box))) return;
    const [x, y] = dome ? place : [place[0], Math.min(box.height - 6, place[1] + 16)];
    node.append(text(x, y + (dome ? 4 : 0), letter, "sw-compass"));
  }

  /** @type {(node: SVGElement, elevation: number, box: { width: number, height: number }) => void} */
  number(node, elevation, box) {
    const { projection, view_azimuth, fov } = this.view.state.values;
    const side = { dome: 45, panorama: -172 }[String(projection)] ?? -0.5 * Number(fov);
    const place = this.view.placeOf([Number(view_azimuth) + side, elevation]);
    if (!place || !inside(place, box)) return;
    const [x, y] = [Math.max(14, place[0]), place[1]];
    node.append(text(x, projection === "dome" ? y + 3 : y - 4, `${elevation}°`, "sw-guide-text"));
  }

  /** @type {(node: SVGElement, box: { width: number, height: number }, left: string, right: string) => void} */
  seam(node, box, left, right) {
    const x = box.width / 2;
    for (const name of ["sw-seam sw-guide-shadow", "sw-seam"]) {
      node.append(shape("line", { x1: x, x2: x, y1: 0, y2: box.height, class: name }));
    }
    const dome = this.view.state.values.projection === "dome";
    // On the dome the corners are free, while its top has a letter and often the sun.
    const y = dome ? 6 : 16;
    const away = dome ? box.width / 2 : 10;
    const write = (/** @type {string} */ model, /** @type {number} */ side) => {
      const absent = model === "bruneton" && this.view.tables === 0;
      const name = absent ? "All orders (no table yet)" : MODEL_LABELS[model];
      const label = text(x + side * away, y, name ?? model, "sw-seam-text");
      setAttributes(label, { "text-anchor": side < 0 !== dome ? "end" : "start" });
      node.append(label);
    };
    write(left, -1);
    write(right, 1);
  }
}

/** @type {(place: Point, box: { width: number, height: number }) => boolean} */
const inside = ([x, y], box) => x >= 0 && y >= 0 && x <= box.width && y <= box.height;

/** @type {(x: number, y: number, content: string, name: string) => SVGTextElement} */
function text(x, y, content, name) {
  const node = shape("text", { x, y, class: name });
  node.textContent = content;
  return node;
}
