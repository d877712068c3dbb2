/** A saved notebook keeps the recipe and a small picture of this editor, not its photo and maps. */

import { MAPS } from "../frame.js";
import { saveLight, thumbnail } from "../saved_state.js";

const EDGE = 640;

/** @type {import("./parts.js").MakePart} */
export function saved(view, signal) {
  const { model, stage } = view;
  /** @type {DataView | null} of the view that was closed */
  let last = null;
  const picture = () => {
    const live = view.scene !== null && view.root.classList.contains("sw-live");
    return thumbnail(live ? stage.canvas : stage.photo, EDGE);
  };
  const nothing = () => new DataView(new ArrayBuffer(0));
  saveLight(model, () => {
    if (model.get("_saved")) return {}; // as it was opened
    if (!model.get("_photo")?.byteLength) return {};
    return {
      ...Object.fromEntries(MAPS.map((name) => [`_${name}`, nothing()])),
      _photo: last ?? picture(),
      _scene: {},
      _saved: true,
    };
  });
  signal.addEventListener("abort", () => {
    if (stage.photo.naturalWidth) last = picture();
  });
  return {};
}
