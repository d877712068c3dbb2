/** Tints the sky or water that the kernel found, while a brush is selected. */

import { BRUSHES } from "./strokes.js";

const OPACITY = 0.45;

/**
 * What brushes can mark: the texture channel that holds it, and its tint (style.css uses the same
 * for strokes).
 *
 * @type {Record<string, { texture: string, channel: number, tint: [number, number, number] }>}
 */
const SUBJECTS = {
  sky: { texture: "layers", channel: 0, tint: [64, 160, 255] },
  water: { texture: "surface", channel: 1, tint: [0, 214, 170] },
};

/**
 * @param {HTMLCanvasElement} canvas
 * @param {import("../../gl/texture.js").Levels} levels
 * @param {string} subject
 */
function paintBrushMask(canvas, { data, width, height }, subject) {
  const context = canvas.getContext("2d", { willReadFrequently: true });
  if (!context) return;
  const { channel, tint } = SUBJECTS[subject];
  canvas.width = width;
  canvas.height = height;
  const image = context.createImageData(width, height);
  for (let i = 0; i < data.length; i += 4) {
    image.data.set(tint, i);
    image.data[i + 3] = data[i + channel] * OPACITY;
  }
  context.putImageData(image, 0, 0);
}

/** The tint shown while a brush is selected. */
export class BrushMask {
  /** @param {import("../types.js").Needs<"drawing" | "hand" | "message" | "stage">} needs */
  constructor({ drawing, hand, message, stage }) {
    this.drawing = drawing;
    this.hand = hand;
    this.message = message;
    this.canvas = stage.mask;
  }

  loaded() {
    this.paint();
  }

  paint() {
    const { subject, tool } = this.hand;
    if (!BRUSHES.includes(tool)) return;
    this.message.attempt(() => {
      const levels = this.drawing.frame.levels(SUBJECTS[subject].texture);
      if (levels) paintBrushMask(this.canvas, levels, subject);
    });
  }
}
