import assert from "node:assert/strict";
import { test } from "node:test";
import { simplify, touches } from "../src/editor/tools/strokes.js";

const size = { width: 200, height: 100 };
const stroke = {
  label: "sky",
  points: [
    [0.2, 0.5],
    [0.6, 0.5],
  ],
  radius: 0.02,
};

test("a disc touches a stroke by its distance in longer sides", () => {
  assert.ok(touches(stroke, [0.4, 0.5], 0.01, size));
  // 0.05 of the height is 0.025 of the width: within 0.02 + 0.01, not within 0.02 + 0.004.
  assert.ok(touches(stroke, [0.4, 0.55], 0.01, size));
  assert.ok(!touches(stroke, [0.4, 0.55], 0.004, size));
  assert.ok(!touches(stroke, [0.7, 0.5], 0.01, size));
});

test("a dot is met, too", () => {
  const dot = { ...stroke, points: [[0.5, 0.5]] };
  assert.ok(touches(dot, [0.51, 0.5], 0.001, size));
  assert.ok(!touches(dot, [0.6, 0.5], 0.01, size));
});

test("a straight stroke keeps its ends, a bent one its bend", () => {
  const straight = Array.from({ length: 50 }, (_, i) => [0.1 + i / 100, 0.5]);
  assert.deepEqual(simplify(straight, 0.001, size), [straight[0], straight[49]]);
  const bent = [...straight, ...straight.map((_, i) => [0.59, 0.5 + i / 100])];
  assert.deepEqual(simplify(bent, 0.001, size), [straight[0], [0.59, 0.5], [0.59, 0.99]]);
  const wave = straight.map(([x], i) => [x, 0.5 + 0.1 * Math.sin(i / 4)]);
  const kept = simplify(wave, 0.001, size);
  assert.ok(kept.length < wave.length && kept.length > 8);
  for (const point of wave) {
    assert.ok(touches({ label: "sky", points: kept, radius: 0.0011 }, point, 0, size));
  }
});

test("a dot and a circle survive", () => {
  assert.deepEqual(simplify([[0.5, 0.5]], 0.01, size), [[0.5, 0.5]]);
  const circle = Array.from({ length: 41 }, (_, i) => [
    0.5 + 0.1 * Math.cos((i * Math.PI) / 20),
    0.5 + 0.2 * Math.sin((i * Math.PI) / 20),
  ]);
  const kept = simplify(circle, 0.002, size);
  assert.ok(kept.length > 6 && kept.length < 41);
});
