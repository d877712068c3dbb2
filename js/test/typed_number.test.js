import assert from "node:assert/strict";
import { test } from "node:test";
import { typedNumber } from "../src/ui/typed_number.js";

const azimuth = { minimum: -180, maximum: 180, unit: "°" };
const elevation = { minimum: -12, maximum: 90, unit: "°" };
const exposure = { minimum: -4, maximum: 4, unit: "EV" };
const strength = { minimum: 0, maximum: 1, unit: "" };

for (const [text, parameter, value] of [
  ["12", elevation, 12],
  [" 12° ", elevation, 12],
  ["3,5 °", elevation, 3.5],
  ["−5", elevation, -5],
  ["500", elevation, 90],
  ["1.5 ev", exposure, 1.5],
  ["190", azimuth, -170],
  ["-190°", azimuth, 170],
  ["180", azimuth, 180],
  ["730", azimuth, 10],
  [".5", strength, 0.5],
  ["", strength, null],
  ["°", azimuth, null],
  ["abc", elevation, null],
  ["2*3", elevation, null],
  ["12 ev", elevation, null],
  ["1e999", elevation, null],
]) {
  test(`"${text}" is ${value} in ${parameter.minimum} to ${parameter.maximum}`, () => {
    assert.equal(typedNumber(text, parameter), value);
  });
}
