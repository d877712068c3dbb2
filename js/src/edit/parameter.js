/** Rows of the kernel's table of parameters. */

/**
 * @param {import("../host/types.js").Parameter[]} parameters
 * @param {string} name
 */
export function parameterOf(parameters, name) {
  const found = parameters.find((p) => p.name === name);
  if (!found) throw new Error(`The kernel's table has no parameter "${name}".`);
  return found;
}
