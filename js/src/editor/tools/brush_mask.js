/** What the kernel holds for sky, or for water, as a tint over the picture while a brush is chosen. */

const OPACITY = 0.45;

/**
 * What brushes can speak about: the texture's channel that holds it, and its tint (style.css has
 * the same for strokes).
 *
 * @type {Record<string, { texture: string, channel: number, tint: [number, number, number] }>}
 */
export const SUBJECTS = {
  sky: { texture: "layers", channel: 0, tint: [64, 160, 255] },
  water: { texture: "surface", channel: 1, tint: [0, 214, 170] },
};

/**
 * @param {HTMLCanvasElement} canvas
 * @param {import("../../gl/texture.js").Levels} levels
 * @param {string} subject
 */
export function paintBrushMask(canvas, { data, width, height }, subject) {
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
