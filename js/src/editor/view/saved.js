/** Makes a saved notebook keep the recipe and a small picture instead of the photo and maps. */

import { MAPS } from "../../gl/frame.js";
import { noBytes, PHOTO, saveLight, thumbnail } from "../../host/saved_state.js";

const EDGE = 640;

/** What a notebook saves while there is no view, and so no picture. */
export const savedWithoutView = () => ({
  ...Object.fromEntries(["photo", ...MAPS].map((name) => [`_${name}`, noBytes()])),
  _scene: {},
});

/**
 * @type {import("../types.js").MakePart<"drawing" | "model" | "panel" | "picture" | "root"
 *   | "stage">}
 */
export function saved({ drawing, model, panel, picture, root, stage }, signal) {
  // Without maps the sliders have no effect.
  panel.node.inert = Boolean(model.get("_saved"));
  root.classList.toggle("sw-saved", panel.node.inert);
  /** @type {Record<string, unknown> | null} saved state of the closed view */
  let last = null;
  const light = () => {
    const live = picture.scene !== null && drawing.live;
    if (live) return { ...savedWithoutView(), _photo: thumbnail(stage.canvas, EDGE) };
    const hasPhoto = stage.photo.naturalWidth > 0;
    return {
      ...savedWithoutView(),
      _photo: hasPhoto ? thumbnail(stage.photo, EDGE) : noBytes(),
      _saved: PHOTO,
    };
  };
  saveLight(model, () => last ?? light());
  signal.addEventListener("abort", () => {
    last = light();
  });
  return {};
}
