import assert from "node:assert/strict";
import { test } from "node:test";
import {
  channel,
  decades,
  onPrincipalPlane,
  planeDirection,
  polar,
  SUN_ELEVATIONS,
  sample,
  WAVELENGTHS,
} from "../src/explorer/curves.js";

const near = (actual, expected, tolerance = 1e-9) =>
  assert.ok(Math.abs(actual - expected) <= tolerance, `${actual} is not ${expected}`);

test("abscissae begin and end where the passes do", () => {
  near(WAVELENGTHS[0], 380);
  near(WAVELENGTHS[63], 780);
  near(SUN_ELEVATIONS[0], -1);
  near(SUN_ELEVATIONS[95], 90);
});

test("a channel of the texels", () => {
  assert.deepEqual(channel(new Float32Array([1, 2, 3, 4, 5, 6, 7, 8]), 2), [3, 7]);
});

test("an even phase function is a circle, and both halves mirror each other", () => {
  const { x, y } = polar(Array(181).fill(0.1), -3);
  assert.equal(x.length, 361);
  for (let i = 0; i < x.length; i++) near(Math.hypot(x[i], y[i]), 2);
  near(x[0], 2);
  near(x[180], -2);
  for (let i = 0; i <= 180; i++) {
    near(x[i], x[360 - i]);
    near(y[i], -y[360 - i]);
  }
});

test("what is below the centre's decade is drawn at the centre", () => {
  const { x } = polar([1e-9, ...Array(180).fill(1)], -3);
  near(x[0], 0);
});

test("decades hold the values and pass over zeros", () => {
  assert.deepEqual(decades([0, 0.02, 3]), [-2, 1]);
  assert.deepEqual(decades([0]), [-3, 0]);
});

test("a sample between abscissae is between the values, and held at the ends", () => {
  near(sample([0, 1, 4], [10, 20, 50], 2.5), 35);
  near(sample([0, 1, 4], [10, 20, 50], 9), 50);
  near(sample([0, 1, 4], [10, 20, 50], -9), 10);
});

test("the principal plane goes from the horizon below the sun over the zenith", () => {
  near(onPrincipalPlane(0, 30).angle, 30);
  near(onPrincipalPlane(180, 30).angle, 150);
  near(onPrincipalPlane(0, 30).away, 0);
  near(onPrincipalPlane(90, 0).away, 90);
  for (const angle of [10, 90, 170]) {
    const [azimuth, elevation] = planeDirection(angle, 25);
    near(onPrincipalPlane(azimuth - 25, elevation).angle, angle);
  }
});
