/** Equality of values and recipes. */

/** @type {(a: unknown, b: unknown) => boolean} */
export function equal(a, b) {
  return a === b || JSON.stringify(a) === JSON.stringify(b);
}

/**
 * Whether two recipes set the same values, apart from the version, which only the kernel writes.
 *
 * @param {import("../host/types.js").Edit} a
 * @param {import("../host/types.js").Edit} b
 */
export function sameRecipe(a, b) {
  const names = new Set([...Object.keys(a), ...Object.keys(b)]);
  names.delete("version");
  return [...names].every((name) => equal(a[name], b[name]));
}
