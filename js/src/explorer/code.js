/** Python that makes this explorer again; the kernel's twin is `SkyExplorer.code()`. */

/** A plain value as Python writes it. @param {unknown} value */
export function literal(value) {
  if (value === null || value === undefined) return "None";
  if (typeof value === "boolean") return value ? "True" : "False";
  if (typeof value === "string") return `'${value.replace(/['\\]/g, "\\$&")}'`;
  return JSON.stringify(value);
}

/**
 * @param {import("../types.js").Edit} recipe values that differ from their defaults
 * @param {boolean} sunFollows time or scan bring the sun along
 */
export function pythonCode(recipe, sunFollows) {
  const named = Object.entries(recipe).filter(
    ([name]) => !(sunFollows && (name === "sun_azimuth" || name === "sun_elevation")),
  );
  const text = named.map(([name, value]) => `${name}=${literal(value)}`).join(", ");
  return `sw.SkyExplorer(${text})`;
}
