/** Statistics of the sky's whiteness for the histogram of the cloud softness C^s. */

/**
 * Shares of the sky that are clear (C^s is 0), soft, and white (C^s is 1).
 *
 * @param {number[]} shares of the sky, by bins of whiteness from 0 to `reach`
 * @param {number} reach
 * @param {number} low m_min
 * @param {number} high m_max
 * @returns {[number, number, number]}
 */
export function spread(shares, reach, low, high) {
  /** @type {[number, number, number]} */
  const sums = [0, 0, 0];
  shares.forEach((share, i) => {
    const whiteness = ((i + 0.5) * reach) / shares.length;
    sums[whiteness <= low ? 0 : whiteness < high ? 1 : 2] += share;
  });
  return sums;
}

/**
 * The histogram's outline as a path, `width` × `height`.
 *
 * @param {number[]} shares
 * @param {number} width
 * @param {number} height
 */
export function outline(shares, width, height) {
  // A few bins often hold most of the sky: the square root keeps the others visible.
  const most = Math.max(...shares) || 1;
  const step = width / (shares.length || 1);
  const steps = shares.map((share, i) => {
    const y = height * (1 - Math.sqrt(share / most));
    return `V${y.toFixed(1)}H${((i + 1) * step).toFixed(2)}`;
  });
  return `M0 ${height}${steps.join("")}V${height}Z`;
}
