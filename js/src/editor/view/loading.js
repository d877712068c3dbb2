/** Loads what the kernel sends of a photo: the preview at once, the analysis later. */

import { Camera } from "../../geometry/camera.js";
import { MAPS } from "../../gl/frame.js";
import { decodePicture } from "../../gl/texture.js";
import { errorText } from "../../host/error_text.js";
import { onTraits } from "../../host/traits.js";

/** @typedef {import("../../host/types.js").Scene} Scene */

export class Loading {
  /**
   * @param {import("../types.js").Needs<"drawing" | "message" | "model" | "parts" | "picture"
   *   | "stage" | "state">} needs
   * @param {AbortSignal} signal
   */
  constructor({ drawing, message, model, parts, picture, stage, state }, signal) {
    this.drawing = drawing;
    this.message = message;
    this.model = model;
    this.parts = parts;
    this.picture = picture;
    this.stage = stage;
    this.state = state;
    this.signal = signal;
    this.loads = 0;
    /** @type {Map<string, unknown>} the bytes of the frame's current pictures */
    this.taken = new Map();
    onTraits(model, ["_photo"], () => void this.photo(), signal);
    onTraits(model, ["_scene"], () => void this.scene(), signal);
    signal.addEventListener("abort", () => {
      this.loads += 1; // ignore pictures that are still being decoded
    });
  }

  async photo() {
    const { model, stage } = this;
    const bytes = model.get("_photo");
    if (!bytes?.byteLength) return;
    try {
      await stage.setPhoto(bytes);
    } catch {
      if (bytes !== model.get("_photo")) return; // another is coming
      this.message.show("The browser cannot decode the preview that the kernel sent.");
      return;
    }
    // Wait until the photo is on the screen: compiling blocks the browser's graphics process.
    requestAnimationFrame(() => setTimeout(() => void this.prepare(bytes)));
  }

  /**
   * During the analysis start compiling the shaders, since some drivers take seconds, and hand them the photo.
   *
   * @param {ArrayBufferView} bytes of the photo
   */
  async prepare(bytes) {
    const { frame, loop } = this.drawing;
    if (this.signal.aborted || this.picture.scene || !loop.visible) return;
    const load = this.loads;
    try {
      frame.withGraph((graph) => graph.prepare([String(this.state.values.method)]));
      const bitmap = await decodePicture(bytes);
      if (load === this.loads) this.take("photo", bytes, bitmap);
      else bitmap.close();
    } catch {
      // The first frame will report the error.
    }
  }

  /**
   * @param {string} name
   * @param {unknown} bytes
   * @param {ImageBitmap} bitmap
   */
  take(name, bytes, bitmap) {
    const { width, height } = bitmap;
    this.drawing.frame.setPicture(name, bitmap);
    this.taken.set(name, bytes);
    if (name === "photo") this.picture.size = [width, height];
  }

  /** Load the analysis: decode its maps, then swap them all at once. */
  async scene() {
    const { message, model, parts, picture } = this;
    /** @type {Scene | null} */
    const scene = model.get("_scene");
    const photo = model.get("_photo");
    if (!scene?.uniforms) this.forget();
    if (!scene?.uniforms || !photo?.byteLength) return;
    this.loads += 1;
    const load = this.loads;
    try {
      // A correction changes some maps but never the photo.
      const sent = ["photo", ...MAPS].map((name) => ({ name, bytes: model.get(`_${name}`) }));
      const fresh = sent.filter(({ name, bytes }) => bytes !== this.taken.get(name));
      const bitmaps = await Promise.all(fresh.map(({ bytes }) => decodePicture(bytes)));
      if (load !== this.loads) {
        for (const bitmap of bitmaps) bitmap.close();
        return;
      }
      fresh.forEach(({ name, bytes }, i) => {
        this.take(name, bytes, bitmaps[i]);
      });
    } catch (error) {
      if (load !== this.loads) return;
      message.show(`The analysis maps cannot be shown: ${errorText(error)}`);
      return;
    }
    const { fov_vertical_deg, pitch, roll } = scene.camera;
    const camera = new Camera(scene.width, scene.height, fov_vertical_deg, pitch, roll);
    picture.take(scene, camera);
    parts.loaded(scene);
  }

  /** Another photo is coming: drop everything about the last one. */
  forget() {
    if (!this.picture.scene) return;
    this.loads += 1;
    this.picture.forget();
    this.parts.forget();
  }
}
