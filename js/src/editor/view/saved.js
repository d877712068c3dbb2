/** A saved notebook keeps the recipe and a small picture of this editor, not its photo and maps. */

import { MAPS } from "../../gl/frame.js";
import { nothing, PHOTO, saveLight, thumbnail } from "../../host/saved_state.js";

const EDGE = 640;

/** Without a view there is no picture either. */
export const unseen = () => ({
  ...Object.fromEntries(["photo", ...MAPS].map((name) => [`_${name}`, nothing()])),
  _scene: {},
});

/**
 * @type {import("../types.js").MakePart<"drawing" | "model" | "panel" | "picture" | "root"
 *   | "stage">}
 */
export function saved({ drawing, model, panel, picture, root, stage }, signal) {
  // Without maps no slider moves the picture.
  panel.node.inert = Boolean(model.get("_saved"));
  root.classList.toggle("sw-saved", panel.node.inert);
  /** @type {Record<string, unknown> | null} of the view that was closed */
  let last = null;
  const light = () => {
    const live = picture.scene !== null && drawing.live;
    if (live) return { ...unseen(), _photo: thumbnail(stage.canvas, EDGE) };
    const there = stage.photo.naturalWidth > 0;
    return {
      ...unseen(),
      _photo: there ? thumbnail(stage.photo, EDGE) : nothing(),
      _saved: PHOTO,
    };
  };
  saveLight(model, () => last ?? light());
  signal.addEventListener("abort", () => {
    last = light();
  });
  return {};
}
