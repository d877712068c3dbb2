/** How white the sky's pixels are, counted for the histogram of the cloud softness C^s. */

/** Red over blue up to which the histogram reaches, and its bins. */
export const REACH = 1.6;
export const BINS = 64;

const SAMPLE_EDGE = 256; // as many pixels as the histogram looks at on the longer side

/**
 * Count encoded red over blue, weighted by the sky matte; the sun's glare is left out.
 *
 * @param {Uint8ClampedArray} photo RGBA
 * @param {Uint8ClampedArray} layers RGBA, red is the sky matte
 * @param {Uint8ClampedArray} surface RGBA, red is the old sun's glare
 * @returns {Float64Array} shares of the sky, the last bin with all that lies beyond
 */
export function histogram(photo, layers, surface) {
  const counts = new Float64Array(BINS);
  let total = 0;
  for (let i = 0; i < photo.length; i += 4) {
    const sky = layers[i];
    if (sky < 128 || surface[i] > 127) continue;
    const ratio = photo[i] / Math.max(1, photo[i + 2]);
    counts[Math.min(BINS - 1, Math.floor((ratio / REACH) * BINS))] += sky;
    total += sky;
  }
  return total ? counts.map((count) => count / total) : counts;
}

/**
 * Shares of the sky that are clear (C^s is 0), soft, and white (C^s is 1).
 *
 * @param {Float64Array} counts as `histogram` gives them
 * @param {number} low m_min
 * @param {number} high m_max
 * @returns {[number, number, number]}
 */
export function spread(counts, low, high) {
  /** @type {[number, number, number]} */
  const shares = [0, 0, 0];
  counts.forEach((share, i) => {
    const ratio = ((i + 0.5) * REACH) / BINS;
    shares[ratio <= low ? 0 : ratio < high ? 1 : 2] += share;
  });
  return shares;
}

/**
 * The pixels of some pictures, all shrunk to one small size.
 *
 * @param {ImageBitmap[]} pictures
 */
export function sample(pictures) {
  const [{ width, height }] = pictures;
  const scale = Math.min(1, SAMPLE_EDGE / Math.max(width, height));
  const size = [width, height].map((n) => Math.max(1, Math.round(n * scale)));
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = size;
  const context = canvas.getContext("2d", { willReadFrequently: true });
  if (!context) throw new Error("This browser offers no 2-D canvas.");
  return pictures.map((picture) => {
    context.drawImage(picture, 0, 0, canvas.width, canvas.height);
    return context.getImageData(0, 0, canvas.width, canvas.height).data;
  });
}
