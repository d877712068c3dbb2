import assert from "node:assert/strict";
import { test } from "node:test";
import {
  angleBetween,
  clock,
  horizonElevation,
  sunAt,
  trueElevation,
  turned,
} from "../src/geometry/day.js";

const near = (actual, expected, tolerance = 1e-6) =>
  assert.ok(Math.abs(actual - expected) <= tolerance, `${actual} is not ${expected}`);

test("between two rows the sun is between them, and on a row it is there", () => {
  const day = [
    [6, 90, 10, 9.9],
    [6.5, 96, 16, 15.95],
    [7, 102, 22, 21.96],
  ];
  const { azimuth, apparent, true: truly } = sunAt(day, 6.25);
  near(azimuth, 93, 0.05); // the way between is an arc, not a line in angles
  near(apparent, 13, 0.05);
  near(truly, 12.925);
  near(sunAt(day, 7).apparent, 22);
  near(sunAt(day, 23).apparent, 22);
  near(sunAt(day, 0).azimuth, 90);
});

test("through north the sun goes the short way", () => {
  const day = [
    [0, 358, -20, -20],
    [1, 4, -20, -20],
  ];
  near(sunAt(day, 0.5).azimuth, 1);
});

test("past the zenith the azimuth swings, the sun does not", () => {
  const day = [
    [12, 90, 89, 89],
    [12.1, 270, 89, 89],
  ];
  near(sunAt(day, 12.05).apparent, 90, 1e-4);
});

test("without a table there is no sun to place", () => {
  assert.equal(sunAt([], 12), null);
});

test("refraction lifts the sun by 34 minutes at the horizon and by nothing in deep twilight", () => {
  near(trueElevation(0), -0.575, 0.01); // Bennett 1982: 34.5′
  near(trueElevation(90), 90, 1e-3);
  near(trueElevation(-8), -8);
  let last = Number.NEGATIVE_INFINITY;
  for (let h = -12; h <= 20; h += 0.01) {
    const truly = trueElevation(h);
    assert.ok(truly > last && truly <= h + 1e-12, `at ${h}`);
    assert.ok(truly - last < 0.1 || last === Number.NEGATIVE_INFINITY, `a jump at ${h}`);
    last = truly;
  }
});

test("hours are read as a clock, angles within half a turn", () => {
  assert.equal(clock(14.0833), "14:05");
  assert.equal(clock(0), "00:00");
  assert.equal(turned(190), -170);
  assert.equal(turned(-180), -180);
});

test("the angle between directions", () => {
  near(angleBetween([0, 0], [90, 0]), 90);
  near(angleBetween([10, 89.999], [10, 90]), 0.001);
  near(angleBetween([0, 30], [180, 30]), 120);
});

test("from thirty kilometres the ground ends 5.6 degrees below the level", () => {
  near(horizonElevation(0), 0);
  near(horizonElevation(30000), -5.55, 0.01); // acos(6360 / 6390)
});
