/**
 * Shows one analysis map over the picture, with a legend, a histogram of its values and the value
 * under the pointer. A map is fetched on demand, once per scene.
 */

import { decodePicture } from "../../gl/texture.js";
import { errorText } from "../../host/error_text.js";
import { button } from "../../ui/button.js";
import { element, setAttributes, shape } from "../../ui/element.js";
import { ceiling, hill, spreadOf } from "./levels.js";
import { gradient, rampColors, textAt } from "./ramp.js";

/**
 * @typedef {import("../../host/types.js").Point} Point
 * @typedef {import("../../host/types.js").SceneMap} SceneMap
 * @typedef {{ levels: Uint8Array, width: number, height: number }} MapLevels
 */

const [SPREAD_WIDTH, SPREAD_HEIGHT] = [256, 20];

export class Inspector {
  /** @param {import("../types.js").Needs<"channel" | "model" | "picture" | "root">} needs */
  constructor({ channel, model, picture, root }) {
    this.channel = channel;
    this.picture = picture;
    this.root = root;
    /** @type {SceneMap[]} */
    this.maps = model.get("_maps") ?? [];
    /** @type {SceneMap | null} the map that is shown */
    this.map = null;
    /** @type {MapLevels | null} */
    this.data = null;
    /** @type {unknown} the scene that `data` belongs to */
    this.scene = null;
    /** @type {Map<string, MapLevels>} by name, of `knownScene` */
    this.known = new Map();
    /** @type {unknown} */
    this.knownScene = null;
    this.asked = 0;
    /** @type {Point | null} */
    this.place = null;

    this.choice = element(
      "select",
      { class: "sw-select sw-show", "aria-label": "Show", title: "Show an analysis map (M)" },
      element("option", { value: "" }, "Picture"),
      element(
        "optgroup",
        { label: "Analysis" },
        ...this.maps.map(({ name, title }) => element("option", { value: name }, title)),
      ),
    );
    this.choice.addEventListener("change", () => this.choose(this.choice.value));
    this.canvas = element("canvas", { class: "sw-map", "aria-hidden": "true" });
    this.title = element("b");
    this.help = element("span", { class: "sw-legend-help" });
    this.marker = element("span", { class: "sw-legend-marker" });
    this.spread = shape("path");
    this.bar = element("span", { class: "sw-legend-bar" }, this.marker);
    const over = shape(
      "svg",
      {
        class: "sw-legend-spread",
        viewBox: `0 0 ${SPREAD_WIDTH} ${SPREAD_HEIGHT}`,
        preserveAspectRatio: "none",
        "aria-hidden": "true",
      },
      this.spread,
    );
    this.low = element("span");
    this.high = element("span");
    // Not announced: it changes with every pointer move.
    this.value = element("output", {
      class: "sw-legend-value",
      "aria-label": "Value at pointer",
      "aria-live": "off",
    });
    this.opacity = element("input", {
      type: "range",
      class: "sw-range",
      min: 0.1,
      max: 1,
      step: 0.05,
      value: 1,
      "aria-label": "Map opacity",
      title: "Map opacity",
    });
    this.opacity.addEventListener("input", () => this.setOpacity());
    const ramp = element("span", { class: "sw-legend-ramp" }, over, this.bar);
    this.scale = element("span", { class: "sw-legend-scale" }, this.low, ramp, this.high);
    this.position = element("span", { class: "sw-legend-position" });
    const steps = element(
      "span",
      { class: "sw-legend-steps" },
      button({
        icon: "chevron",
        label: "Previous map",
        title: "Previous map (Shift+M)",
        onClick: () => this.step(-1),
      }),
      this.position,
      button({
        icon: "chevron",
        label: "Next map",
        title: "Next map (M)",
        onClick: () => this.step(1),
      }),
    );
    const close = button({
      icon: "close",
      label: "Close the map",
      title: "Close the map (Esc)",
      onClick: () => this.choose(""),
    });
    this.node = element(
      "div",
      { class: "sw-legend", role: "group", "aria-label": "Analysis map", hidden: true },
      element("span", { class: "sw-legend-name" }, this.title, this.value),
      this.scale,
      this.opacity,
      steps,
      close,
      this.help,
    );
    this.setOpacity();
  }

  setOpacity() {
    const share = Number(this.opacity.value);
    this.canvas.style.opacity = String(share);
    this.opacity.style.setProperty("--sw-share", String((share - 0.1) / 0.9));
  }

  /** Show a map by name; an empty name shows the picture again. @param {string} name */
  choose(name) {
    this.map = this.maps.find((map) => map.name === name) ?? null;
    this.choice.value = this.map?.name ?? "";
    this.node.hidden = !this.map;
    this.data = null;
    this.scene = null;
    this.canvas.width = 0;
    this.root.classList.toggle("sw-inspecting", this.map !== null);
    if (!this.map) return;
    const { title, help, ramp } = this.map;
    this.title.textContent = title;
    this.position.textContent = `${this.maps.indexOf(this.map) + 1} / ${this.maps.length}`;
    setAttributes(this.spread, { d: "" });
    this.help.textContent = help;
    this.low.textContent = textAt(this.map, 0);
    this.high.textContent = textAt(this.map, 1);
    this.bar.style.backgroundImage = gradient(ramp);
    this.readValue();
    void this.refresh();
  }

  /** Show the next or previous map; the picture follows the last one. @param {1 | -1} direction */
  step(direction) {
    const names = ["", ...this.maps.map(({ name }) => name)];
    const at = names.indexOf(this.map?.name ?? "");
    this.choose(names[(at + direction + names.length) % names.length]);
  }

  /** Fetch the map, unless the one shown belongs to the current scene. */
  async refresh() {
    const { map } = this;
    const { scene } = this.picture;
    if (!map || !scene || this.scene === scene) return;
    this.scene = scene;
    this.asked += 1;
    const { asked } = this;
    if (this.knownScene !== scene) this.known.clear();
    this.knownScene = scene;
    const known = this.known.get(map.name);
    if (known) {
      this.node.classList.remove("sw-waiting"); // a request for another map is abandoned
      return this.paint(map, known);
    }
    this.node.classList.add("sw-waiting");
    try {
      const { buffers } = await this.channel.request("map", { name: map.name });
      const bitmap = await decodePicture(buffers[0]);
      const data = levelsOf(bitmap);
      bitmap.close();
      if (data && this.knownScene === scene) this.known.set(map.name, data);
      if (data && asked === this.asked && map === this.map) this.paint(map, data);
    } catch (error) {
      if (asked !== this.asked) return;
      this.data = null;
      this.canvas.width = 0;
      // Most often the photo has no such map, for instance no sun.
      this.help.textContent = errorText(error);
      this.readValue();
    } finally {
      if (asked === this.asked) this.node.classList.remove("sw-waiting");
    }
  }

  /** @param {SceneMap} map @param {MapLevels} data */
  paint(map, data) {
    const { canvas } = this;
    const { levels, width, height } = data;
    [canvas.width, canvas.height] = [width, height];
    const image = new ImageData(width, height);
    const pixels = new Uint32Array(image.data.buffer);
    const table = new Uint32Array(rampColors(map.ramp).buffer);
    for (let i = 0; i < pixels.length; i++) pixels[i] = table[levels[i]];
    canvas.getContext("2d")?.putImageData(image, 0, 0);
    const spread = spreadOf(levels);
    setAttributes(this.spread, {
      d: hill(spread, ceiling([spread]), SPREAD_WIDTH, SPREAD_HEIGHT),
    });
    this.data = data;
    this.help.textContent = map.help;
    this.readValue();
  }

  loaded() {
    void this.refresh();
  }

  /** Paint the map again after its canvas was cleared. */
  repaint() {
    this.scene = null;
    void this.refresh();
  }

  /** Take the pointer's position on the picture; null when it has left. @param {Point | null} place */
  point(place) {
    this.place = place;
    if (this.map) this.readValue();
  }

  readValue() {
    const { data, map, place } = this;
    let share = null;
    if (data && place?.every((n) => n >= 0 && n < 1)) {
      const [x, y] = [Math.floor(place[0] * data.width), Math.floor(place[1] * data.height)];
      share = data.levels[y * data.width + x] / 255;
    }
    this.marker.hidden = share === null;
    this.value.textContent = map && share !== null ? textAt(map, share) : "";
    if (share !== null) this.marker.style.left = `${100 * share}%`;
  }
}

/** @param {ImageBitmap} bitmap gray levels @returns {MapLevels | null} */
function levelsOf(bitmap) {
  const { width, height } = bitmap;
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [width, height];
  const context = canvas.getContext("2d", { willReadFrequently: true });
  if (!context) return null;
  context.drawImage(bitmap, 0, 0);
  const { data } = context.getImageData(0, 0, width, height);
  return {
    levels: Uint8Array.from({ length: width * height }, (_, i) => data[4 * i]),
    width,
    height,
  };
}
