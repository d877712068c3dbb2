import assert from "node:assert/strict";
import { test } from "node:test";
import { aside, degrees, directionText, sunText } from "../src/ui/angle_text.js";

test("a sign is a minus, and an azimuth has a side instead", () => {
  assert.equal(degrees(-2.04), "−2.0°");
  assert.equal(degrees(12.6, 0), "13°");
  assert.equal(aside(-8.1), "8.1° left");
  assert.equal(aside(0), "0.0° right");
  assert.equal(directionText(8.14, -0.96), "8.1° right · −1.0°");
  assert.equal(sunText(-20, 4), "Sun 20.0° left · 4.0° elevation");
});
