/**
 * Looks up uniform values in the edit, the scene or the host. The kernel's twin is
 * `sunwidget/renderer/values.py`.
 */

/**
 * @typedef {import("../host/types.js").Edit} Edit
 * @typedef {import("../host/types.js").Parameter} Parameter
 * @typedef {Record<string, number | number[]>} Values
 */

/**
 * Return an edit's numbers, with automatic ones filled in, and the index of each choice.
 *
 * @param {Parameter[]} parameters
 * @param {Edit} edit
 * @param {Record<string, number>} automatic
 * @returns {Values}
 */
export function parameterValues(parameters, edit, automatic) {
  /** @type {Values} */
  const values = {};
  for (const p of parameters) {
    const value = edit[p.name] ?? p.default;
    if (p.kind === "choice") values[p.name] = p.choices.indexOf(String(value));
    if (p.kind === "number") values[p.name] = Number(value ?? automatic[p.name]);
  }
  return values;
}

/**
 * Return the values of both states, each with the `source_…` names added.
 *
 * @param {Parameter[]} parameters
 * @param {Edit} edit
 * @param {Record<string, number>} automatic
 * @returns {{ source: Values, edit: Values }}
 */
export function states(parameters, edit, automatic) {
  const source = parameterValues(parameters, {}, automatic);
  const current = parameterValues(parameters, edit, automatic);
  const fixed = Object.fromEntries(
    Object.entries(source).map(([name, value]) => [`source_${name}`, value]),
  );
  // The method is not a property of the picture: both states use the chosen one.
  if ("method" in current) source.method = current.method;
  return { source: { ...source, ...fixed }, edit: { ...current, ...fixed } };
}

/**
 * Look `name` up in `tables` in turn; a miss names shader and uniform.
 *
 * @param {string} shader
 * @param {string} name
 * @param {Values[]} tables
 */
export function uniformValue(shader, name, ...tables) {
  for (const table of tables) {
    const value = table[name];
    if (value !== undefined) return value;
  }
  throw new Error(
    `Shader "${shader}" declares uniform "${name}", which is neither a parameter of the edit, ` +
      "a scene uniform of graph.json nor a host uniform.",
  );
}
