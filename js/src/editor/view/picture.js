/** The current picture: the analysis of its photo, and the edit that it shows. */

/**
 * @typedef {import("../../geometry/camera.js").Camera} Camera
 * @typedef {import("../../host/types.js").Edit} Edit
 * @typedef {import("../../host/types.js").Model} Model
 * @typedef {import("../../host/types.js").Scene} Scene
 */

export class Picture {
  /**
   * @param {Model} model
   * @param {Pick<import("../../edit/state.js").EditState, "values" | "recipe">} state
   */
  constructor(model, state) {
    this.model = model;
    this.state = state;
    /** @type {Scene | null} */
    this.scene = null;
    /** @type {Camera | null} */
    this.camera = null;
    /** @type {[number, number]} size of the preview in pixels */
    this.size = [0, 0];
    /** @type {Edit | null} the film moment shown in place of the edit */
    this.passing = null;
  }

  /** @param {Scene} scene @param {Camera} camera */
  take(scene, camera) {
    this.scene = scene;
    this.camera = camera;
  }

  forget() {
    this.scene = null;
    this.camera = null;
  }

  /** The edit, or a moment of a film. @returns {Edit} */
  get shown() {
    return this.passing ?? this.state.values;
  }

  /** A parameter's effective number: the user's, or else from the analysis. @param {string} name */
  value(name) {
    return Number(this.shown[name] ?? this.scene?.automatic[name] ?? 0);
  }

  /**
   * The recipe and photo of a request for a picture. Hosts delay traits but not requests while the
   * kernel is busy: without them the kernel could answer with an older edit than the user saw.
   */
  requestContent() {
    return { recipe: this.state.recipe(), photo: this.model.get("_source")?.fingerprint };
  }
}
