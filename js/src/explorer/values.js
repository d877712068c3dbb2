/**
 * What SkyExplorer's parameters are as uniforms; the kernel's twin is `sunwidget/explorer/values.py`.
 *
 * Switches are applied here, so that a shader knows an atmosphere without haze and not a switch
 * that hides it.
 */

/**
 * @typedef {import("../host/types.js").Edit} Edit
 * @typedef {import("../host/types.js").Parameter} Parameter
 */

/** What a switch that is off sets to zero. @type {Record<string, string>} */
export const SWITCHED_OFF = {
  show_rayleigh: "air_density",
  show_aerosol: "aerosol_optical_depth",
  show_ozone: "ozone",
};

/**
 * The values of every uniform in both states: `edit`, the atmosphere as chosen, and `single`,
 * the same with the first order of scattering alone.
 *
 * @param {Parameter[]} parameters rows of the explorer's table
 * @param {Edit} values by name; a missing one is at its default
 * @returns {{ edit: Record<string, number>, single: Record<string, number> }} numbers as they
 *   are, a choice's index, 0 or 1 for a switch; data are no uniforms
 */
export function effectiveValues(parameters, values) {
  /** @type {Record<string, number>} */
  const edit = {};
  for (const p of parameters) {
    const value = values[p.name] ?? p.default;
    if (p.kind === "choice") edit[p.name] = p.choices.indexOf(String(value));
    else if (p.kind !== "data") edit[p.name] = Number(value);
  }
  for (const [name, silenced] of Object.entries(SWITCHED_OFF)) {
    if (edit[name] === 0) edit[silenced] = 0;
  }
  // Beside another model, the state "edit" is that model's.
  if (values.model === "single" && ["none", "single"].includes(String(values.compare ?? "none"))) {
    edit.scattering_orders = 1;
  }
  return { edit, single: { ...edit, scattering_orders: 1 } };
}
