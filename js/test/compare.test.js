import assert from "node:assert/strict";
import { test } from "node:test";
import { ciede2000, lab, pictureDifference } from "../src/compare/color_difference.js";
import { columns } from "../src/compare/columns.js";

test("CIEDE2000 of pairs that Sharma, Wu and Dalal published", () => {
  /** @type {[number[], number[], number][]} */
  const pairs = [
    [[50, 2.6772, -79.7751], [50, 0, -82.7485], 2.0425],
    [[50, -1.3802, -84.2814], [50, 0, -82.7485], 1.0],
    [[50, 0, 0], [50, -1, 2], 2.3669],
    [[50, 2.49, -0.001], [50, -2.49, 0.0009], 7.1792],
    [[50, 2.49, -0.001], [50, -2.49, 0.0011], 7.2195],
    [[50, -0.001, 2.49], [50, 0.0009, -2.49], 4.8045],
    [[50, 2.5, 0], [50, 0, -2.5], 4.3065],
    [[50, 2.5, 0], [73, 25, -18], 27.1492],
    [[60.2574, -34.0099, 36.2677], [60.4626, -34.1751, 39.4387], 1.2644],
    [[22.7233, 20.0904, -46.694], [23.0331, 14.973, -42.5619], 2.0373],
    [[2.0776, 0.0795, -1.135], [0.9033, -0.0636, -0.5514], 0.9082],
  ];
  for (const [one, other, expected] of pairs) {
    assert.ok(Math.abs(ciede2000(one, other) - expected) < 5e-5, `${one} ${other}`);
    assert.ok(Math.abs(ciede2000(other, one) - expected) < 5e-5, `${other} ${one}`);
    assert.equal(ciede2000(one, one), 0);
  }
});

test("sRGB to CIE Lab: white, black, and a colour that scikit-image was asked for", () => {
  const near = (/** @type {number[]} */ one, /** @type {number[]} */ other) =>
    one.forEach((value, i) => {
      assert.ok(Math.abs(value - other[i]) < 0.02, `${one} is not ${other}`);
    });
  near(lab(255, 255, 255), [100, 0, 0]);
  near(lab(0, 0, 0), [0, 0, 0]);
  near(lab(200, 30, 90), [44.1609, 65.8066, 10.615]);
});

test("a picture's difference: mean and what nearly all pixels stay below", () => {
  const grey = (/** @type {number[]} */ levels) =>
    Uint8ClampedArray.from(levels.flatMap((level) => [level, level, level, 255]));
  const one = grey(Array(100).fill(100));
  const other = grey([...Array(90).fill(100), ...Array(10).fill(200)]);
  const far = ciede2000(lab(100, 100, 100), lab(200, 200, 200));
  const { mean, high } = pictureDifference(one, other);
  assert.ok(Math.abs(mean - far / 10) < 1e-9);
  assert.equal(high, far);
  assert.deepEqual(pictureDifference(one, one), { mean: 0, high: 0 });
});

test("pictures stand so that they are large and few places are empty", () => {
  const at = (/** @type {number} */ count, /** @type {number} */ width) =>
    columns(count, width, 680, 1.5).columns;
  assert.deepEqual(
    [2, 3, 4, 6, 9].map((count) => at(count, 1170)),
    [2, 3, 2, 3, 3],
  );
  assert.deepEqual(
    [2, 3].map((count) => at(count, 340)),
    [1, 1],
  );
  for (const [count, width] of [
    [2, 1170],
    [5, 900],
    [9, 340],
  ]) {
    const found = columns(count, width, 680, 1.5);
    const rows = Math.ceil(count / found.columns);
    assert.ok(found.width * found.columns <= width);
    assert.ok((found.width / 1.5) * rows <= 680);
  }
});
