/**
 * SkyExplorer's parameters as uniforms; the kernel's twin is `sunwidget/explorer/values.py`.
 *
 * Switches are applied here, so that shaders see an atmosphere without haze rather than a switch.
 */

/**
 * @typedef {import("../host/types.js").Edit} Edit
 * @typedef {import("../host/types.js").Parameter} Parameter
 */

/** The parameter that each switch sets to zero when off. @type {Record<string, string>} */
export const SWITCHED_OFF = {
  show_rayleigh: "air_density",
  show_aerosol: "aerosol_optical_depth",
  show_ozone: "ozone",
};

/**
 * Return every uniform in both states: `edit`, the chosen atmosphere, and `single`, the same with
 * only the first order of scattering.
 *
 * @param {Parameter[]} parameters rows of the explorer's table
 * @param {Edit} values by name; a missing one is at its default
 * @returns {{ edit: Record<string, number>, single: Record<string, number> }} numbers
 *   unchanged, a choice's index, 0 or 1 for a switch; data are not uniforms
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
  // In a comparison, the state "edit" belongs to the other model.
  if (values.model === "single" && ["none", "single"].includes(String(values.compare ?? "none"))) {
    edit.scattering_orders = 1;
  }
  return { edit, single: { ...edit, scattering_orders: 1 } };
}
