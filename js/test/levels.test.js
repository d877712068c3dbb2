import assert from "node:assert/strict";
import { test } from "node:test";
import { BINS, ceiling, countLevels, hill } from "../src/editor/inspect/levels.js";

/** @param {...number[]} colours RGB of each pixel */
const pixels = (...colours) => new Uint8ClampedArray(colours.flatMap((rgb) => [...rgb, 255]));

test("every channel is counted, and what is clipped", () => {
  const levels = countLevels(pixels([0, 0, 0], [255, 10, 10], [128, 128, 128], [0, 200, 0]));
  for (const name of /** @type {const} */ (["red", "green", "blue", "luminance"])) {
    assert.equal(levels[name].length, BINS);
    assert.equal(
      levels[name].reduce((a, b) => a + b),
      1,
    );
  }
  assert.equal(levels.red[0], 0.5);
  assert.equal(levels.red[BINS - 1], 0.25);
  assert.equal(levels.green[200 / 4], 0.25);
  assert.deepEqual(levels.clipped, { black: 0.25, white: 0.25 });
});

test("luminance is of linear light, and grey keeps its level", () => {
  for (const level of [0, 3, 20, 128, 254, 255]) {
    const { luminance } = countLevels(pixels([level, level, level]));
    assert.equal(luminance.indexOf(1), Math.floor(level / 4), `grey ${level}`);
  }
  // Full red is 0.2126 of the light, which sRGB encodes as 127; a mean of codes would say 54.
  assert.equal(countLevels(pixels([255, 0, 0])).luminance.indexOf(1), Math.floor(127 / 4));
});

test("a peak of one bin does not press the rest to the ground", () => {
  const bins = new Array(BINS).fill(0.001);
  bins[0] = 0.5;
  bins[30] = 0.4;
  assert.equal(ceiling([bins, bins, bins]), 0.001);
  assert.match(hill([0, 1, 0.25], 0.5, 30, 10), /^M0 10L5\.0 10\.0L15\.0 0\.0L25\.0 5\.0L30 10Z$/);
});

test("no pixels, no levels", () => {
  const levels = countLevels(pixels());
  assert.equal(Math.max(...levels.luminance), 0);
  assert.doesNotMatch(hill(levels.red, ceiling([levels.red]), 10, 10), /NaN/);
});
