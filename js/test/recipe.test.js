import assert from "node:assert/strict";
import { test } from "node:test";
import { checkRecipe } from "../src/edit/recipe/check.js";
import { readRecipe } from "../src/edit/recipe/read.js";
import { toJson, toPython } from "../src/edit/recipe/write.js";

const row = (name, rest) => ({ name, unit: "", choices: [], ...rest });
const parameters = [
  row("sun_elevation", { kind: "number", default: null, minimum: -12, maximum: 90, unit: "°" }),
  row("exposure", { kind: "number", default: 0, minimum: -4, maximum: 4, unit: "EV" }),
  row("method", { kind: "choice", default: "ratio", choices: ["ratio", "thesis"] }),
  row("strokes", { kind: "data", default: [] }),
  row("sun_hint", { kind: "data", default: null }),
  row("horizon_hint", { kind: "data", default: null }),
  row("fov_hint", { kind: "data", default: null }),
  row("place", { kind: "data", default: null }),
];
const full = {
  sun_elevation: -1.25e-7,
  exposure: 0.1 + 0.2,
  method: "thesis",
  strokes: [
    {
      label: "sky",
      points: [
        [0.1, 0.2],
        [1, -1],
      ],
      radius: 0.02,
    },
  ],
  sun_hint: [0.5, 0.25],
  horizon_hint: [
    [0, 0.5],
    [1, 0.4],
  ],
  fov_hint: 38,
  place: { latitude: 41, longitude: -29.5, date: "2024-06-21", time: 17.5, heading: null },
};

test("a recipe comes back from both its texts to the last bit", () => {
  for (const recipe of [full, {}, { exposure: 1 }]) {
    for (const text of [toJson(recipe), toPython(recipe)]) {
      const { values, problems } = checkRecipe(parameters, readRecipe(text));
      assert.deepEqual(values, recipe);
      assert.deepEqual(problems, []);
    }
  }
});

test("the sun's hint is a place or outside", () => {
  for (const [hint, taken] of [
    ["outside", true],
    ["inside", false],
    [["outside"], false],
    [[0.5, -2], true],
  ]) {
    const { problems } = checkRecipe(parameters, { sun_hint: hint });
    assert.equal(problems.length === 0, taken, JSON.stringify(hint));
  }
  const recipe = { sun_hint: "outside" };
  assert.deepEqual(readRecipe(toPython(recipe)), recipe);
});

test("Python is read as people and Edit.to_code write it", () => {
  const text = `
# an evening
edit = sunwidget.Edit(sun_elevation = 3, exposure=-.5,  # darker
    strokes=(sw.Stroke('sky', ((0.1, 0.2), (1_0e-1, 1.)), radius=2e-2),), method='thesis',
    sun_hint=None, place=sw.Place(latitude=41.0, longitude=29.0, date='2024-06-21', time=5.0))
editor.edit = edit`;
  assert.deepEqual(readRecipe(text), {
    sun_elevation: 3,
    exposure: -0.5,
    strokes: [
      {
        label: "sky",
        points: [
          [0.1, 0.2],
          [1, 1],
        ],
        radius: 0.02,
      },
    ],
    method: "thesis",
    sun_hint: null,
    place: { latitude: 41, longitude: 29, date: "2024-06-21", time: 5 },
  });
});

test("what is no plain value is refused with its line, and nothing is run", () => {
  globalThis.ran = false;
  for (const text of [
    "sw.Edit(exposure=__import__('os').system('id'))",
    "sw.Edit(exposure=globalThis.ran=true)",
    "sw.Edit(exposure=1+1)",
    "sw.Edit(exposure=f(1))",
    "sw.Edit(\n1)",
    "sw.Edit(exposure=1",
    "sw.Edit(exposure=[1 2])",
    `sw.Edit(strokes=${"[".repeat(100_000)}`,
  ]) {
    assert.throws(() => readRecipe(text), /Line \d+ of the recipe/);
  }
  for (const text of ["", "sunset", "[1]", "3", "null", "{", "globalThis.ran = true"]) {
    assert.throws(() => readRecipe(text), /no recipe/);
  }
  assert.equal(globalThis.ran, false);
});

test("hostile names stay names", () => {
  const given = readRecipe('{"__proto__": {"exposure": 3}, "constructor": 1, "exposure": 2}');
  const { values, problems } = checkRecipe(parameters, given);
  assert.deepEqual(values, { exposure: 2 });
  assert.equal(problems.length, 2);
  assert.equal({}.exposure, undefined);
  assert.deepEqual(readRecipe("sw.Edit(__proto__={'a': 1})").a, undefined);
});

test("every value that the table does not take is left out and named", () => {
  const bad = {
    sun_elevation: 91,
    exposure: null,
    method: "magic",
    strokes: [{ label: "sea", points: [[0, 0]], radius: 0.01 }],
    sun_hint: [1],
    horizon_hint: [
      [0.5, 0],
      [0.5, 1],
    ],
    fov_hint: "wide",
    place: { latitude: 100 },
    glow: 1,
  };
  const { values, problems } = checkRecipe(parameters, bad);
  assert.deepEqual(values, {});
  assert.equal(problems.length, Object.keys(bad).length);
  assert.match(problems[0], /sun_elevation is a number from -12 to 90 °, not 91/);
  assert.match(problems.at(-1), /no parameter "glow"/);
});

test("a stroke of a thousand wrong kinds is refused, not drawn", () => {
  for (const stroke of [null, 3, {}, { label: "sky" }, { label: "sky", points: [] }]) {
    assert.deepEqual(checkRecipe(parameters, { strokes: [stroke] }).values, {});
  }
  const points = Array.from({ length: 100_001 }, () => [0, 0]);
  assert.deepEqual(checkRecipe(parameters, { strokes: [{ label: "sky", points }] }).values, {});
});

test("a recipe of a newer version asks for an update, one without a version is read", () => {
  assert.match(checkRecipe(parameters, { version: 99 }).problems[0], /Update sunwidget/);
  assert.match(checkRecipe(parameters, { version: "1" }).problems[0], /not a whole number/);
  assert.deepEqual(checkRecipe(parameters, { exposure: 1 }).values, { exposure: 1 });
  for (const value of [null, 3, "x", []]) {
    assert.equal(checkRecipe(parameters, value).problems.length, 1);
  }
});
