/** Draws the picture's frame on the stage's canvas when needed, no larger than visible. */

import { Frame } from "../../gl/frame.js";
import { FrameLoop } from "../../gl/frame_loop.js";
import { watchVisibility } from "../../host/visibility.js";

const WORTHWHILE = 0.75; // share of the preview's size below which a drag draws smaller

export class Drawing {
  /**
   * @param {import("../types.js").Needs<"message" | "parts" | "picture" | "root" | "stage"
   *   | "state">} needs
   * @param {AbortSignal} signal
   */
  constructor({ message, parts, picture, root, stage, state }, signal) {
    this.message = message;
    this.parts = parts;
    this.picture = picture;
    this.root = root;
    this.stage = stage;
    this.frame = new Frame(stage.canvas, state.parameters);
    this.live = false; // whether the canvas shows the scene
    this.speed = ""; // drawing speed and graphics card (timings.js)
    this.loop = new FrameLoop(
      (scale) => this.drawFrame(scale),
      () => state.before !== null || picture.passing !== null,
      signal,
    );
    this.loop.limit = () => this.visibleScale();
    this.loop.setVisible(false); // until the page is laid out
    watchVisibility(root, signal, (visible) => this.loop.setVisible(visible));
  }

  /** @param {import("../../host/types.js").Scene} scene */
  loaded(scene) {
    this.frame.setScene(scene);
    this.loop.first = true;
  }

  forget() {
    this.setLive(false);
  }

  show() {
    this.loop.request();
  }

  /** @param {boolean} live */
  setLive(live) {
    this.live = live;
    this.root.classList.toggle("sw-live", live);
  }

  /** Share of the preview's size that the screen can show; 1 if less would gain little. */
  visibleScale() {
    const shown = this.stage.rectangle().width * (window.devicePixelRatio || 1);
    const scale = shown / Math.max(1, this.picture.size[0]);
    return scale < WORTHWHILE ? scale : 1;
  }

  /** @param {number} scale of the full size */
  drawFrame(scale) {
    const { parts, picture } = this;
    parts.draw();
    if (!picture.scene) return;
    const [width, height] = picture.size;
    /** @type {[number, number]} */
    const size = [Math.max(1, Math.round(width * scale)), Math.max(1, Math.round(height * scale))];
    const drawn = this.message.attempt(() => this.frame.draw(picture.shown, size));
    if (drawn) {
      this.setLive(true);
      parts.drawn(scale);
    } else if (drawn === false) {
      this.loop.request(); // the context was lost; the next frame makes a new one
    }
  }
}
