/** A saved notebook keeps small pictures of what is compared, not the photo and its maps. */

import { nothing, PHOTO, saveLight, thumbnail } from "../host/saved_state.js";

const EDGE = 960; // of all pictures together: more of them are smaller ones

/** Without a view there is no picture either. */
export const unseen = () => ({ _photo: nothing(), _scenes: [] });

/** @param {import("./view.js").View} view @param {AbortSignal} signal */
export function saved(view, signal) {
  const { model, panels } = view;
  /** @type {Record<string, unknown> | null} of the view that was closed */
  let last = null;
  const light = () => {
    if (!panels.some(({ drawn }) => drawn)) {
      const [{ canvas, filled }] = panels;
      return { ...unseen(), _photo: filled ? thumbnail(canvas, EDGE) : nothing(), _saved: PHOTO };
    }
    const edge = EDGE / Math.sqrt(panels.length);
    const variants = panels.map(({ variant, canvas, drawn }) =>
      drawn ? { ...variant, picture: thumbnail(canvas, edge) } : variant,
    );
    return { ...unseen(), _variants: variants };
  };
  saveLight(model, () => last ?? light());
  signal.addEventListener("abort", () => {
    last = light();
  });
}
