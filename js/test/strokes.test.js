import assert from "node:assert/strict";
import { test } from "node:test";
import { meets } from "../src/editor/strokes.js";
import { BINS, histogram, REACH, spread } from "../src/editor/whiteness.js";

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

const rgba = (...pixels) => new Uint8ClampedArray(pixels.flat());

test("the histogram counts red over blue of the sky without the sun's glare", () => {
  const photo = rgba([100, 0, 200, 255], [200, 0, 200, 255], [50, 0, 200, 255], [9, 0, 9, 255]);
  const layers = rgba([255, 0, 0, 255], [255, 0, 0, 255], [0, 0, 0, 255], [255, 0, 0, 255]);
  const surface = rgba([0, 0, 0, 255], [0, 0, 0, 255], [0, 0, 0, 255], [255, 0, 0, 255]);
  const counts = histogram(photo, layers, surface);
  const bin = (ratio) => Math.floor((ratio / REACH) * BINS);
  assert.equal(counts[bin(0.5)], 0.5);
  assert.equal(counts[bin(1)], 0.5);
  assert.deepEqual(spread(counts, 0.62, 1.2), [0.5, 0.5, 0]);
  assert.deepEqual(spread(counts, 0.2, 0.8), [0, 0.5, 0.5]);
});

test("without sky there is nothing to count", () => {
  const none = rgba([0, 0, 0, 255]);
  assert.deepEqual(spread(histogram(none, none, none), 0.6, 1), [0, 0, 0]);
});
