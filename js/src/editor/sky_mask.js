/** The kernel's sky matte as a tint over the picture, shown while a brush is chosen. */

const TINT = [64, 160, 255];
const OPACITY = 0.45;

/**
 * @param {HTMLCanvasElement} canvas
 * @param {ImageBitmap} layers red is the sky matte
 */
export function paintSkyMask(canvas, layers) {
  const context = canvas.getContext("2d", { willReadFrequently: true });
  if (!context) return;
  canvas.width = layers.width;
  canvas.height = layers.height;
  context.drawImage(layers, 0, 0);
  const image = context.getImageData(0, 0, canvas.width, canvas.height);
  const { data } = image;
  for (let i = 0; i < data.length; i += 4) {
    const sky = data[i];
    [data[i], data[i + 1], data[i + 2]] = TINT;
    data[i + 3] = sky * OPACITY;
  }
  context.putImageData(image, 0, 0);
}
