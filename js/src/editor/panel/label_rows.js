/**
 * Place labels without overlap: in order, each at its row or as far below as those above it
 * require.
 *
 * @param {number[]} rows wanted
 * @param {number} height of a label
 */
export function labelRows(rows, height) {
  const placed = [...rows];
  let next = -Infinity;
  const order = rows.map((_, i) => i).sort((a, b) => rows[a] - rows[b]);
  for (const i of order) {
    placed[i] = Math.max(rows[i], next);
    next = placed[i] + height;
  }
  return placed;
}
