/** The presets, each with a thumbnail of this photo under it. */

import { presetChips } from "../../ui/chips.js";
import { element } from "../../ui/element.js";

/** @typedef {import("../../ui/chips.js").Preset} Preset */

const PLACES = 6;

/** @type {import("../types.js").MakePart<"panel" | "picture" | "state" | "thumbnails">} */
export function presetThumbnails({ panel, picture, state, thumbnails }) {
  /** @type {{ preset: Preset, canvas: HTMLCanvasElement }[]} */
  let all = [];
  let generation = 0; // incremented with every scene

  const chips = presetChips(
    state,
    () => picture.scene?.presets ?? [],
    (preset) => {
      const canvas = element("canvas", { class: "sw-thumbnail", "aria-hidden": "true" });
      thumbnails.placePhoto(canvas);
      all = all.filter((one) => one.preset.label !== preset.label);
      all.push({ preset, canvas });
      return canvas;
    },
  );
  // Placeholders until the analysis has determined what each preset sets.
  const places = Array.from({ length: PLACES }, () =>
    element("span", { class: "sw-chip" }, "\u00a0"),
  );
  for (const place of places) place.prepend(element("canvas", { class: "sw-thumbnail" }));
  const waiting = element("div", { class: "sw-presets sw-preset-places", "aria-hidden": "true" });
  waiting.append(...places);
  panel.top.append(chips.node, waiting);

  /** Identify what a thumbnail shows; a sun moved by hand does not change it. @param {Preset} preset */
  const keyOf = (preset) => {
    const numbers = state.parameters.filter(({ kind }) => kind !== "data");
    return JSON.stringify([
      generation,
      ...numbers.map(({ name }) => preset.values[name] ?? state.values[name]),
    ]);
  };
  const drawn = thumbnails.keep(chips.node, () =>
    all.map(({ preset, canvas }) => ({
      canvas,
      edit: { ...state.values, ...preset.values },
      key: keyOf(preset),
    })),
  );

  return {
    loaded() {
      generation += 1;
    },
    show() {
      chips.show();
      waiting.hidden = !chips.node.hidden;
      drawn.wake();
    },
    drawn: () => drawn.wake(),
  };
}
