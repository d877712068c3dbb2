/** Makes a saved notebook keep small pictures of the comparison instead of the photo and maps. */

import { noBytes, PHOTO, saveLight, thumbnail } from "../host/saved_state.js";

const EDGE = 960; // for all pictures together: more pictures are smaller

/** What a notebook saves while there is no view, and so no picture. */
export const savedWithoutView = () => ({ _photo: noBytes(), _scenes: [] });

/**
 * @param {import("./types.js").Needs<"model" | "panels">} needs
 * @param {AbortSignal} signal
 */
export function saved({ model, panels }, signal) {
  /** @type {Record<string, unknown> | null} saved state of the closed view */
  let last = null;
  const light = () => {
    if (!panels.some(({ drawn }) => drawn)) {
      const [{ canvas, filled }] = panels;
      return {
        ...savedWithoutView(),
        _photo: filled ? thumbnail(canvas, EDGE) : noBytes(),
        _saved: PHOTO,
      };
    }
    const edge = EDGE / Math.sqrt(panels.length);
    const variants = panels.map(({ variant, canvas, drawn }) =>
      drawn ? { ...variant, picture: thumbnail(canvas, edge) } : variant,
    );
    return { ...savedWithoutView(), _variants: variants };
  };
  saveLight(model, () => last ?? light());
  signal.addEventListener("abort", () => {
    last = light();
  });
}
