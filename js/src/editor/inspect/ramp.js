/** Levels, values and colors of an inspected map. The kernel's table is `analysis/maps.py`. */

/** @typedef {import("../../host/types.js").SceneMap} SceneMap */

/**
 * The value of a share, level / 255.
 *
 * @param {SceneMap} map
 * @param {number} share 0–1
 */
export function valueAt(map, share) {
  if (map.scale === "log") return map.low * (map.high / map.low) ** share;
  return map.low + (map.high - map.low) * share;
}

/**
 * Format a value for display; the last level of a logarithmic map stands for infinity.
 *
 * @param {SceneMap} map
 * @param {number} share 0–1
 */
export function textAt(map, share) {
  const unit = map.unit === "°" ? "°" : map.unit && ` ${map.unit}`;
  if (map.scale === "log") {
    if (share >= 1) return "∞";
    const value = valueAt(map, share);
    if (map.unit === "m" && value >= 1000) return `${Number((value / 1000).toPrecision(2))} km`;
    return `${Number(value.toPrecision(2))}${unit}`;
  }
  const decimals = map.high - map.low > 10 ? 1 : 2;
  return `${valueAt(map, share).toFixed(decimals).replace("-", "−")}${unit}`;
}

/**
 * The ramp as 256 colors, RGBA in bytes.
 *
 * @param {SceneMap["ramp"]} ramp
 */
export function rampColors(ramp) {
  const stops = ramp.map(([at, text]) => ({
    at,
    rgba: [1, 3, 5, 7].map((i) => Number.parseInt(text.slice(i, i + 2), 16)),
  }));
  const table = new Uint8ClampedArray(1024);
  let next = 1;
  for (let level = 0; level < 256; level++) {
    while (next < stops.length - 1 && level / 255 > stops[next].at) next += 1;
    const [a, b] = [stops[next - 1], stops[next]];
    const share = Math.min(1, Math.max(0, (level / 255 - a.at) / (b.at - a.at)));
    for (let i = 0; i < 4; i++) table[4 * level + i] = a.rgba[i] + share * (b.rgba[i] - a.rgba[i]);
  }
  return table;
}

/**
 * The ramp as a CSS background.
 *
 * @param {SceneMap["ramp"]} ramp
 */
export const gradient = (ramp) =>
  `linear-gradient(to right, ${ramp.map(([at, text]) => `${text} ${100 * at}%`).join(", ")})`;
