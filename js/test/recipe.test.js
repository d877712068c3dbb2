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

const noKernel = () => assert.fail("no kernel is asked");

test("a recipe comes back from its JSON to the last bit, without a kernel", async () => {
  for (const recipe of [full, {}, { exposure: 1 }]) {
    const given = await readRecipe(toJson(recipe), noKernel);
    assert.deepEqual(checkRecipe(parameters, given), { values: recipe, problems: [] });
  }
});

test("Python that builds an edit goes to the kernel as it is, and its answer comes back", async () => {
  const recipe = { version: 1, exposure: 2 };
  for (const text of [toPython(full), "edit = Edit (exposure=2)"]) {
    const kernel = async (/** @type {string} */ sent) => sent === text && recipe;
    assert.equal(await readRecipe(text, kernel), recipe);
  }
  const refuse = () => Promise.reject(new Error("Line 1"));
  await assert.rejects(readRecipe("sw.Edit(exposure=f(1))", refuse), /Line 1/);
  const long = `sw.Edit(strokes=[${"0,".repeat(3_000_000)}])`;
  await assert.rejects(readRecipe(long, noKernel), /too long/);
});

test("what is neither JSON nor an edit's Python is refused, and nothing is run", async () => {
  globalThis.ran = false;
  for (const text of [
    "",
    "sunset",
    "{",
    "globalThis.ran = true",
    "Editor(globalThis.ran = true)",
  ]) {
    await assert.rejects(readRecipe(text, noKernel), /No recipe/);
  }
  assert.equal(globalThis.ran, false);
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
});

test("hostile names stay names", () => {
  const given = JSON.parse('{"__proto__": {"exposure": 3}, "constructor": 1, "exposure": 2}');
  const { values, problems } = checkRecipe(parameters, given);
  assert.deepEqual(values, { exposure: 2 });
  assert.equal(problems.length, 2);
  assert.equal({}.exposure, undefined);
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
