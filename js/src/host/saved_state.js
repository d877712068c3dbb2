/**
 * What a notebook file keeps of a widget. JupyterLab saves every trait; the maps and the preview of a
 * photo are megabytes, which the kernel makes again. So they are left out of what is saved, and only
 * there: kernel, further views and a page that is loaded again have all of them.
 */

/** @typedef {import("./types.js").Model} Model */

const PROBE = "_connection";

/**
 * ipywidgets' own model. anywidget hands on no property of it, but its events name it; other
 * hosts have none.
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
  // A name that is no trait: the kernel passes over it.
  model.on(`change:${PROBE}`, listen);
  model.set(PROBE, {});
  model.set(PROBE, null);
  model.off(`change:${PROBE}`, listen);
  return found;
}

/**
 * From now on this is saved in place of traits that are heavy; of a widget that was opened as it
 * had been saved, what was saved.
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

/** In place of true: what is shown is the photo, as nothing else was drawn. */
export const PHOTO = "photo";

/**
 * What a widget that was opened as it had been saved says of itself.
 *
 * @param {Model} model
 * @param {string} what it is
 */
export const savedText = (model, what) =>
  model.get("_saved") === PHOTO
    ? `The notebook saved only the photo and the recipe. Run the cell to see the ${what}.`
    : `This is a saved picture of the ${what}. Run the cell again to continue.`;

/** No bytes, as traits hold them. */
export const nothing = () => new DataView(new ArrayBuffer(0));

/** A small JPEG of a picture, long edge at most `edge`. @param {HTMLCanvasElement | HTMLImageElement} picture @param {number} edge */
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
  return new DataView(Uint8Array.from(text, (sign) => sign.charCodeAt(0)).buffer);
}
