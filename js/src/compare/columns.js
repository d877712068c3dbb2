/** Chooses the number of columns that makes the pictures largest. */

const GAP = 2; // CSS pixels between pictures
const HOLE = 0.35; // penalty of an empty place in the last row

/**
 * @param {number} count pictures
 * @param {number} width of the room in CSS pixels
 * @param {number} tallest limit of the rows' total height
 * @param {number} aspect width over height of a picture
 * @returns {{ columns: number, width: number }} and how wide a picture is
 */
export function columns(count, width, tallest, aspect) {
  let best = { columns: 1, width: 0, worth: -1 };
  for (let n = 1; n <= count; n++) {
    const rows = Math.ceil(count / n);
    const wide = (width - GAP * (n - 1)) / n;
    const high = (tallest - GAP * (rows - 1)) / rows;
    const fitting = Math.max(1, Math.min(wide, high * aspect));
    const worth = fitting * (1 - HOLE * (n * rows - count));
    if (worth > best.worth) best = { columns: n, width: fitting, worth };
  }
  return { columns: best.columns, width: best.width };
}
