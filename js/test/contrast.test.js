import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";

const read = (path) => readFileSync(new URL(`../src/${path}`, import.meta.url), "utf-8");
const SCHEMES = ["light", "dark"];

/** Colour custom properties of a style sheet: [light, dark] by name. */
function tokens(css) {
  const found = {};
  for (const [, name, value] of css.matchAll(/--sw-([\w-]+):\s*([^;]+);/g)) {
    const pair = value.match(/^light-dark\((.+?\)?), (.+)\)$/);
    const colors = (pair ? pair.slice(1) : [value, value]).map(parse);
    if (colors.every(Boolean)) found[name] = colors;
  }
  return found;
}

/** [red, green, blue, alpha] of `#rrggbb` or `rgb(r g b / a%)`, or null. */
function parse(text) {
  const hex = text.match(/^#(..)(..)(..)$/);
  if (hex) return [...hex.slice(1).map((digits) => Number.parseInt(digits, 16)), 1];
  const rgb = text.match(/^rgb\((\d+) (\d+) (\d+)(?: \/ (\d+)%)?\)$/);
  return rgb && [...rgb.slice(1, 4).map(Number), Number(rgb[4] ?? 100) / 100];
}

const over = (top, under) =>
  [0, 1, 2].map((i) => top[3] * top[i] + (1 - top[3]) * under[i]).concat(1);

/** Relative luminance (WCAG 2.2). */
function luminance(color) {
  const [r, g, b] = color.slice(0, 3).map((byte) => {
    const v = byte / 255;
    return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function contrast(a, b) {
  const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (high + 0.05) / (low + 0.05);
}

const SHARED = tokens(read("ui/colors.css"));
const PLOTS = tokens(read("explorer/style.css"));

// What stands on what; a list of grounds lies one on the other, the last at the bottom.
const TEXT = [
  ["text", ["panel", "field", "hover", "selected"]],
  ["quiet", ["panel", "field", "hover"]],
  ["accent-text", ["panel", "field", "hover", "selected"]],
  ["error-text", ["error-back"]],
  ["note-text", ["note-back"]],
  ["solid-text", ["solid"]],
  ["good", ["panel", "field"]],
  ["stage-text", ["surround", ["stage-hover", "surround"], ["stage-press", "surround"]]],
  ["stage-quiet", ["surround", ["stage-hover", "surround"]]],
  ["stage-accent", ["surround"]],
  ["stage-note", ["surround"]],
  [
    "plate-text",
    [
      ["plate", "mark"],
      ["stage-hover", "plate", "mark"],
      ["stage-press", "plate", "mark"],
    ],
  ],
];
const SIGNS = [
  ["accent", ["panel", "track"]],
  ["field-line", ["panel", "field"]],
  ["selected-line", ["panel"]],
  ["focus", ["panel", "field", "hover", "selected"]],
  ["red", ["field", "panel"]],
  ["green", ["field", "panel"]],
  ["blue", ["field", "panel"]],
  ["mark", ["surround"]],
  ["mark-accent", ["surround"]],
];

/** The rows of a table that fall short of a ratio. */
function short(rows, least) {
  const failing = [];
  for (const [name, grounds] of rows) {
    for (const ground of grounds) {
      for (const [i, scheme] of SCHEMES.entries()) {
        const layers = [ground].flat().map((key) => SHARED[key][i]);
        const under = layers.reduceRight((below, layer) => over(layer, below), [0, 0, 0, 1]);
        const front = over((SHARED[name] ?? PLOTS[name])[i], under);
        const ratio = contrast(front, under);
        if (ratio < least) failing.push(`${name} on ${ground} (${scheme}): ${ratio.toFixed(2)}`);
      }
    }
  }
  return failing;
}

test("contrast is that of the standard's examples", () => {
  assert.equal(contrast(parse("#000000"), parse("#ffffff")), 21);
  assert.ok(Math.abs(contrast(parse("#767676"), parse("#ffffff")) - 4.54) < 0.005);
});

test("text is read in both schemes", () => {
  assert.deepEqual(short(TEXT, 4.5), []);
});

test("what carries meaning is seen in both schemes", () => {
  assert.deepEqual(short(SIGNS, 3), []);
});

test("the lines of the plots are seen on their cards", () => {
  const lines = Object.keys(PLOTS).filter((name) => !(name in SHARED));
  assert.ok(lines.length >= 7);
  assert.deepEqual(
    short(
      lines.map((name) => [name, ["panel"]]),
      3,
    ),
    [],
  );
});

test("no part has colours of its own", () => {
  const sheets = readdirSync(new URL("../src", import.meta.url), { recursive: true })
    .map((path) => path.replaceAll("\\", "/"))
    .filter((path) => path.endsWith(".css"));
  assert.ok(sheets.includes("ui/colors.css"));
  const own = sheets.flatMap((path) =>
    read(path)
      .split("\n")
      .filter((line) => /#[0-9a-f]{3,8}\b|\brgb\(/.test(line) && !/^\s*--sw-/.test(line))
      .map((line) => `${path}: ${line.trim()}`),
  );
  assert.deepEqual(own, []);
});
