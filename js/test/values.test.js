import assert from "node:assert/strict";
import { test } from "node:test";
import { passSize } from "../src/gl/graph.js";
import { states, uniformValue } from "../src/gl/values.js";

const parameters = [
  { name: "sun_elevation", kind: "number", default: null },
  { name: "exposure", kind: "number", default: 0 },
  { name: "method", kind: "choice", default: "ratio", choices: ["ratio", "thesis"] },
  { name: "light_source", kind: "choice", default: "sun", choices: ["sun", "moon"] },
  { name: "strokes", kind: "data", default: [] },
];

test("an automatic parameter takes what the analysis found", () => {
  const { edit } = states(parameters, { sun_elevation: null }, { sun_elevation: 12.5 });
  assert.equal(edit.sun_elevation, 12.5);
});

test("the source state does not move with the edit", () => {
  const { source, edit } = states(
    parameters,
    { sun_elevation: 3, exposure: 1, method: "thesis" },
    { sun_elevation: 12.5 },
  );
  assert.deepEqual([source.sun_elevation, source.exposure], [12.5, 0]);
  assert.deepEqual([edit.sun_elevation, edit.exposure], [3, 1]);
  assert.equal(edit.source_sun_elevation, 12.5);
  assert.equal(source.method, 1, "both states are drawn by the chosen method");
});

test("a choice is its index, and at its default in the source", () => {
  const { source, edit } = states(parameters, { light_source: "moon" }, { sun_elevation: 0 });
  assert.deepEqual([edit.light_source, source.light_source, edit.source_light_source], [1, 0, 0]);
});

test("strokes are no uniform", () => {
  assert.ok(!("strokes" in states(parameters, {}, { sun_elevation: 0 }).edit));
});

test("a uniform without a source names shader and uniform", () => {
  assert.throws(() => uniformValue("frame", "typo", {}), /"frame".*"typo"/);
});

test("sizes are fixed, the frame's, or a share of it rounded up", () => {
  assert.deepEqual(passSize([8, 1], [101, 50]), [8, 1]);
  assert.deepEqual(passSize("frame", [101, 50]), [101, 50]);
  assert.deepEqual(passSize(["frame", 4], [101, 50]), [26, 13]);
});

test("a size may be a name that the host gives a meaning", () => {
  assert.deepEqual(passSize("grid", [101, 50], { grid: [128, 64] }), [128, 64]);
});
