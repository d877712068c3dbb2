import assert from "node:assert/strict";
import { test } from "node:test";
import { Camera } from "../src/geometry/camera.js";

const close = (actual, expected, tolerance) =>
  assert.ok(Math.abs(actual - expected) <= tolerance, `${actual} is not ${expected}`);

// The worked example that the kernel's camera is tested with too.
const example = new Camera(1600, 1200, 50, 8, 3);

test("the worked example's focal length and zenith are met", () => {
  close(example.focal, 1286.704, 1e-3);
  [0.051827, -0.988911, 0.139173].forEach((value, i) => {
    close(example.up[i], value, 1e-6);
  });
});

test("the worked example's pixel has its azimuth and elevation", () => {
  const [azimuth, elevation] = example.angles(1200, 150);
  close(azimuth, 17.2751, 1e-4);
  close(elevation, 26.9944, 1e-4);
});

test("pixel is the inverse of angles, also outside the frame", () => {
  for (const [x, y] of [
    [800, 600],
    [-900, 40],
    [2500, 1900],
    [1200, -700],
  ]) {
    const [u, v] = example.pixel(...example.angles(x, y));
    close(u, x, 1e-6);
    close(v, y, 1e-6);
  }
});

test("a direction behind the camera has no pixel but a bearing", () => {
  assert.equal(example.pixel(180, 10), null);
  close(Math.hypot(...example.bearing(180, 10)), 1, 1e-12);
});
