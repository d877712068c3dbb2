import assert from "node:assert/strict";
import { test } from "node:test";
import { gradient, rampColors, textAt, valueAt } from "../src/editor/inspect/ramp.js";

const share = { low: 0, high: 1, unit: "", scale: "linear" };
const angle = { low: -45, high: 45, unit: "°", scale: "linear" };
const depth = { low: 1, high: 100_000, unit: "m", scale: "log" };

test("shares become values on either scale", () => {
  assert.equal(valueAt(angle, 0.5), 0);
  assert.equal(valueAt(angle, 1), 45);
  assert.equal(valueAt(depth, 0), 1);
  assert.ok(Math.abs(valueAt(depth, 0.4) - 100) < 1e-9);
});

test("values are read with their unit", () => {
  assert.equal(textAt(share, 0.256), "0.26");
  assert.equal(textAt(angle, 0.25), "−22.5°");
  assert.equal(textAt(depth, 0.4), "100 m");
  assert.equal(textAt(depth, 0.7), "3.2 km");
  assert.equal(textAt(depth, 1), "∞");
});

test("a ramp meets its stops and is straight between them", () => {
  const table = rampColors([
    [0, "#00000000"],
    [0.2, "#ff000080"],
    [1, "#ffff00ff"],
  ]);
  assert.deepEqual([...table.slice(0, 4)], [0, 0, 0, 0]);
  assert.deepEqual([...table.slice(51 * 4, 51 * 4 + 4)], [255, 0, 0, 128]);
  assert.deepEqual([...table.slice(-4)], [255, 255, 0, 255]);
  const [, green] = table.slice(153 * 4, 153 * 4 + 4);
  assert.ok(Math.abs(green - 127.5) <= 1);
});

test("a legend shows the same stops", () => {
  assert.equal(
    gradient([
      [0, "#00000000"],
      [1, "#ffffffff"],
    ]),
    "linear-gradient(to right, #00000000 0%, #ffffffff 100%)",
  );
});
