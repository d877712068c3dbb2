/** Python code that recreates this explorer; the kernel's twin is `SkyExplorer.code()`. */

/** Write a plain value in Python; every number of the table is a float there. @param {unknown} value */
export function literal(value) {
  if (value === null || value === undefined) return "None";
  if (typeof value === "boolean") return value ? "True" : "False";
  if (typeof value === "number") return Number.isInteger(value) ? `${value}.0` : String(value);
  return `'${String(value).replace(/['\\]/g, "\\$&")}'`;
}

const SUN = ["sun_azimuth", "sun_elevation"];

/**
 * @param {import("../host/types.js").Edit} recipe values that differ from their defaults
 * @param {[number, number] | null} sun azimuth and elevation; null if it follows from time, scan
 *   or defaults
 */
export function pythonCode(recipe, sun) {
  const named = Object.entries(recipe).filter(([name]) => !SUN.includes(name));
  if (sun) named.push(...SUN.map((name, i) => /** @type {[string, unknown]} */ ([name, sun[i]])));
  const text = named.map(([name, value]) =>
    name === "scan" ? `scan=${value}` : `${name}=${literal(value)}`,
  );
  return `sw.SkyExplorer(${text.join(", ")})`;
}
