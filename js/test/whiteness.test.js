import assert from "node:assert/strict";
import { test } from "node:test";
import { outline, spread } from "../src/editor/panel/whiteness.js";

test("shares below, between and above the thresholds", () => {
  // Bins of 0.4: centres 0.2, 0.6, 1.0, 1.4.
  const shares = [0.1, 0.2, 0.3, 0.4];
  const near = (a, b) =>
    assert.ok(
      a.every((value, i) => Math.abs(value - b[i]) < 1e-12),
      a,
    );
  near(spread(shares, 1.6, 0.5, 1.2), [0.1, 0.5, 0.4]);
  near(spread(shares, 1.6, 0.1, 3), [0, 1, 0]);
  near(spread([], 1.6, 0.5, 1), [0, 0, 0]);
});

test("the outline's highest bin reaches the top and stands where its bin is", () => {
  assert.equal(outline([0, 0.8, 0.2], 30, 10), "M0 10V10.0H10.00V0.0H20.00V5.0H30.00V10Z");
  assert.equal(outline([], 30, 10), "M0 10V10Z");
});
