/** Writes a recipe's non-default values as text: JSON for files, Python for cells. */

import { RECIPE_VERSION } from "./check.js";

/** @typedef {import("../../host/types.js").Edit} Edit */

/** @param {Edit} recipe */
export const toJson = (recipe) =>
  `${JSON.stringify({ version: RECIPE_VERSION, ...recipe }, null, 2)}\n`;

/**
 * Python that builds the same `Edit`.
 *
 * @param {Edit} recipe
 */
export function toPython(recipe) {
  const values = Object.entries(recipe).map(([name, value]) => `    ${name}=${python(value)},\n`);
  const edit = values.length ? `sw.Edit(\n${values.join("")})` : "sw.Edit()";
  return `import sunwidget as sw\n\nedit = ${edit}\n`;
}

/** @param {any} value @returns {string} */
function python(value) {
  if (value === null || value === undefined) return "None";
  if (typeof value === "boolean") return value ? "True" : "False";
  if (typeof value === "number") return String(value);
  if (typeof value === "string") return quoted(value);
  if (Array.isArray(value)) return `[${value.map(python).join(", ")}]`;
  if (isStroke(value)) {
    return `sw.Stroke(${quoted(value.label)}, ${python(value.points)}, radius=${value.radius})`;
  }
  const items = Object.entries(value).map(([name, item]) => `${quoted(name)}: ${python(item)}`);
  return `{${items.join(", ")}}`;
}

/** @param {any} value */
const isStroke = (value) => "label" in value && "points" in value && "radius" in value;

/** Quote a text in ASCII, readable as both JSON and Python. @param {string} text */
const quoted = (text) =>
  JSON.stringify(text).replace(/[^\x20-\x7e]/gu, (character) => {
    const code = character.codePointAt(0) ?? 0;
    return code > 0xffff
      ? `\\U${code.toString(16).padStart(8, "0")}`
      : `\\u${code.toString(16).padStart(4, "0")}`;
  });
