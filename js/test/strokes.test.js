import assert from "node:assert/strict";
import { test } from "node:test";
import { meets } from "../src/editor/strokes.js";

const size = { width: 200, height: 100 };
const stroke = {
  label: "sky",
  points: [
    [0.2, 0.5],
    [0.6, 0.5],
  ],
  radius: 0.02,
};

test("a disc meets a stroke by its distance in longer sides", () => {
  assert.ok(meets(stroke, [0.4, 0.5], 0.01, size));
  // 0.05 of the height is 0.025 of the width: within 0.02 + 0.01, not within 0.02 + 0.004.
  assert.ok(meets(stroke, [0.4, 0.55], 0.01, size));
  assert.ok(!meets(stroke, [0.4, 0.55], 0.004, size));
  assert.ok(!meets(stroke, [0.7, 0.5], 0.01, size));
});

test("a dot is met, too", () => {
  const dot = { ...stroke, points: [[0.5, 0.5]] };
  assert.ok(meets(dot, [0.51, 0.5], 0.001, size));
  assert.ok(!meets(dot, [0.6, 0.5], 0.01, size));
});
