/** Names history steps from the recipes before and after them. */

import { equal, sameRecipe } from "./equality.js";

/**
 * @typedef {import("../host/types.js").Edit} Edit
 * @typedef {import("../host/types.js").Parameter} Parameter
 * @typedef {import("../host/types.js").Version} Version
 */

const SUN = ["sun_azimuth", "sun_elevation", "place"];

/**
 * @param {Edit} from
 * @param {Edit} to
 * @param {{ parameters: Parameter[], versions?: Version[],
 *   presets?: import("../host/types.js").Preset[] }} known
 */
export function stepName(from, to, { parameters, versions = [], presets = [] }) {
  const changed = parameters.filter(({ name }) => !equal(from[name], to[name]));
  const names = changed.map(({ name }) => name);
  if (changed.length === 0) return "Nothing";
  const preset = presets.find(({ values }) => sets(values, names, to, parameters));
  if (preset) return preset.label;
  if (changed.length === 1)
    return names[0] === "strokes" ? strokes(from, to) : fullLabel(changed[0]);
  if (names.every((name) => SUN.includes(name))) return "Sun moved";
  if (names.length > 2 && sameRecipe(to, {})) return "Reset";
  const version = versions.find(({ recipe }) => sameRecipe(recipe, to));
  if (version) return `“${version.name}”`;
  if (changed.length === 2)
    return `${fullLabel(changed[0])} and ${fullLabel(changed[1]).toLowerCase()}`;
  const sections = new Set(changed.map(({ section }) => section));
  return sections.size === 1
    ? `${title(changed[0].section)}, ${changed.length} values`
    : `${changed.length} values`;
}

/**
 * Whether a preset made the step: it sets all its values and nothing else. Recipes omit defaults.
 *
 * @param {Record<string, unknown>} values of the preset
 * @param {string[]} changed
 * @param {Edit} recipe
 * @param {Parameter[]} parameters
 */
function sets(values, changed, recipe, parameters) {
  const known = parameters.filter(({ name }) => name in values);
  return (
    known.length > 1 &&
    changed.every((name) => name in values || SUN.includes(name)) &&
    known.every((p) => equal(recipe[p.name] ?? p.default ?? null, values[p.name]))
  );
}

/** @param {Edit} from @param {Edit} to */
function strokes(from, to) {
  const [before, after] = [from, to].map(({ strokes: s }) => (Array.isArray(s) ? s.length : 0));
  return after > before ? "Stroke" : before - after > 1 ? "Strokes erased" : "Stroke erased";
}

/** Add the section's name, since labels such as "Opacity" repeat. @param {Parameter} parameter */
function fullLabel({ section, label, kind }) {
  if (kind === "data" || label.toLowerCase().startsWith(section)) return label;
  return `${title(section)} ${label.charAt(0).toLowerCase()}${label.slice(1)}`;
}

/** @param {string} text */
const title = (text) => text.charAt(0).toUpperCase() + text.slice(1);
