/**
 * Checks a recipe against the kernel's parameter table before it is used: it may come from a file,
 * the clipboard or an older version. The kernel's twin is `Edit.from_dict`.
 */

/**
 * @typedef {import("../../host/types.js").Edit} Edit
 * @typedef {import("../../host/types.js").Parameter} Parameter
 */

export const RECIPE_VERSION = 1; // of sunwidget/edit/table.py

const LABELS = ["sky", "not_sky", "water", "not_water"];
const STROKE = ["label", "points", "radius"];
const RADIUS = 0.01; // default radius of a stroke
const MOST_POINTS = 100_000; // in all strokes: a message of 10 MiB would break the connection

/**
 * Return the valid values, and a sentence about each invalid one.
 *
 * @param {Parameter[]} parameters
 * @param {unknown} recipe
 * @returns {{ values: Edit, problems: string[] }}
 */
export function checkRecipe(parameters, recipe) {
  if (typeof recipe !== "object" || recipe === null || Array.isArray(recipe)) {
    return { values: {}, problems: ["A recipe is a JSON object with names and values."] };
  }
  const { version = RECIPE_VERSION, ...entries } = /** @type {Edit} */ (recipe);
  if (typeof version !== "number" || !(version >= 1)) {
    return { values: {}, problems: [`Recipe version ${shorten(version)} is not a whole number.`] };
  }
  if (version > RECIPE_VERSION) {
    const problem = `This recipe has version ${version}; this sunwidget reads versions up to ${RECIPE_VERSION}. Update sunwidget to open it.`;
    return { values: {}, problems: [problem] };
  }
  /** @type {Edit} */
  const values = {};
  const problems = [];
  for (const [name, value] of /** @type {[string, any][]} */ (Object.entries(entries))) {
    const row = parameters.find((p) => p.name === name);
    const problem = row ? problemOf(row, value) : `There is no parameter ${shorten(name)}.`;
    if (problem) problems.push(problem);
    else if (name === "strokes") values[name] = value.map(withRadius);
    else values[name] = value;
  }
  return { values, problems };
}

/** @param {Parameter} p @param {any} value @returns {string} empty if the value is valid */
function problemOf(p, value) {
  if (value === null && p.default === null) return "";
  if (p.kind === "choice") {
    return p.choices.includes(value)
      ? ""
      : `${p.name} is one of ${p.choices.join(", ")}, not ${shorten(value)}.`;
  }
  if (p.kind === "number") {
    return isBetween(value, p.minimum, p.maximum)
      ? ""
      : `${p.name} is a number from ${p.minimum} to ${p.maximum} ${p.unit}`.trimEnd() +
          `, not ${shorten(value)}.`;
  }
  const isValid = DATA[/** @type {keyof typeof DATA} */ (p.name)];
  return isValid?.(value) ? "" : `${p.name} cannot be ${shorten(value)}.`;
}

const DATA = {
  strokes: areStrokes,
  sun_hint: (/** @type {any} */ value) => value === "outside" || isPoint(value),
  fov_hint: (/** @type {any} */ value) => isBetween(value, 1, 150),
  horizon_hint: (/** @type {any} */ value) =>
    arePoints(value) && value.length === 2 && value[0][0] !== value[1][0],
  place: isPlace,
};

/** @type {(value: any, low: number, high: number) => boolean} */
const isBetween = (value, low, high) => typeof value === "number" && value >= low && value <= high;

/** @param {any} value */
function isPoint(value) {
  return Array.isArray(value) && value.length === 2 && value.every((x) => isBetween(x, -10, 10));
}

/** @param {any} value */
function arePoints(value) {
  return Array.isArray(value) && value.length > 0 && value.every(isPoint);
}

/** @param {any} value */
function areStrokes(value) {
  if (!Array.isArray(value)) return false;
  let points = 0;
  for (const stroke of value) {
    if (!LABELS.includes(stroke?.label) || !arePoints(stroke.points)) return false;
    if (!isBetween(withRadius(stroke).radius, 0.0005, 0.5)) return false;
    if (Object.keys(stroke).some((name) => !STROKE.includes(name))) return false;
    points += stroke.points.length;
  }
  return points <= MOST_POINTS;
}

/** @param {any} stroke */
const withRadius = (stroke) => ({ ...stroke, radius: stroke.radius ?? RADIUS });

/** @param {any} value */
function isPlace(value) {
  return (
    isBetween(value?.latitude, -90, 90) &&
    isBetween(value.longitude, -180, 180) &&
    isBetween(value.time, 0, 24) &&
    isBetween(value.heading ?? 0, 0, 360) &&
    typeof value.date === "string" &&
    /^\d{4}-\d{2}-\d{2}$/.test(value.date)
  );
}

/** Abbreviate a value's JSON. @param {unknown} value */
function shorten(value) {
  const text = JSON.stringify(value) ?? String(value);
  return text.length > 60 ? `${text.slice(0, 60)}…` : text;
}
