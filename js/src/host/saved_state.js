/**
 * What a notebook file keeps of a widget. JupyterLab saves every trait, but a photo's maps and
 * preview take megabytes and the kernel can make them again. So they are left out of the saved state
 * only; the kernel, further views and a reloaded page have all of them.
 */

/** @typedef {import("./types.js").Model} Model */

const PROBE = "_connection";

/**
 * Return ipywidgets' own model. anywidget does not expose it, but its events pass it; other hosts
 * have none.
 *
 * @param {Model} model
 * @returns {any}
 */
export function ownModel(model) {
  if (!model.widget_manager) return undefined;
  /** @type {any} */
  let found;
  /** @param {any} own */
  const listen = (own) => {
    found = own;
  };
  // Not the name of a trait: the kernel ignores it.
  model.on(`change:${PROBE}`, listen);
  model.set(PROBE, {});
  model.set(PROBE, null);
  model.off(`change:${PROBE}`, listen);
  return found;
}

/**
 * Replace heavy traits in the saved state. A widget opened from a saved notebook keeps its saved
 * state.
 *
 * @param {Model} model
 * @param {() => Record<string, unknown>} light
 */
export function saveLight(model, light) {
  const own = ownModel(model);
  if (typeof own?.get_state !== "function") return;
  const whole = own.constructor.prototype.get_state;
  /** @param {boolean} [dropDefaults] */
  own.get_state = (dropDefaults) => {
    const state = whole.call(own, dropDefaults);
    return model.get("_saved") ? state : { ...state, _saved: true, ...light() };
  };
}

/** Value of `_saved` when the saved picture is the photo, as nothing had been drawn. */
export const PHOTO = "photo";

/**
 * Text of a widget opened from a saved notebook.
 *
 * @param {Model} model
 * @param {string} what name of the widget
 */
export const savedText = (model, what) =>
  model.get("_saved") === PHOTO
    ? `The notebook saved only the photo and the recipe. Run the cell to see the ${what}.`
    : `This is a saved picture of the ${what}. Run the cell again to continue.`;

/** An empty value of a binary trait. */
export const noBytes = () => new DataView(new ArrayBuffer(0));

/** Make a small JPEG of a picture, long edge at most `edge`. @param {HTMLCanvasElement | HTMLImageElement} picture @param {number} edge */
export function thumbnail(picture, edge) {
  const width = "naturalWidth" in picture ? picture.naturalWidth : picture.width;
  const height = "naturalHeight" in picture ? picture.naturalHeight : picture.height;
  const scale = Math.min(1, edge / Math.max(1, width, height));
  const small = document.createElement("canvas");
  small.width = Math.max(1, Math.round(width * scale));
  small.height = Math.max(1, Math.round(height * scale));
  const context = small.getContext("2d", { alpha: false });
  if (context) context.imageSmoothingQuality = "high";
  context?.drawImage(picture, 0, 0, small.width, small.height);
  const text = atob(small.toDataURL("image/jpeg", 0.85).split(",")[1]);
  return new DataView(Uint8Array.from(text, (char) => char.charCodeAt(0)).buffer);
}
