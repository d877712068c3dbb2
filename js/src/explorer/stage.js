/**
 * The sky's stage: the canvas in the middle, guides and handles above, room around it to drag the
 * sun below the horizon.
 */

import { element } from "../ui/element.js";
import { PictureStage } from "../ui/stage.js";
import { ASPECTS } from "./projection.js";

export class SkyStage extends PictureStage {
  /** @param {AbortSignal} signal */
  constructor(signal) {
    const canvas = element("canvas", {
      class: "sw-sky-canvas",
      role: "img",
      "aria-label": "The computed sky",
    });
    const picture = element("div", { class: "sw-sky-picture" }, canvas);
    super(picture, { className: "sw-sky-stage", signal });
    this.canvas = canvas;
  }

  /** @param {string} projection */
  setProjection(projection) {
    this.node.dataset.projection = projection;
    this.picture.style.setProperty("--sw-aspect", String(ASPECTS[projection] ?? 1.5));
  }
}
