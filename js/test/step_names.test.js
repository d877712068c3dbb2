import assert from "node:assert/strict";
import { test } from "node:test";
import { stepName } from "../src/step_names.js";

const row = (name, section, label, kind = "number") => ({ name, section, label, kind });
const known = {
  parameters: [
    row("sun_azimuth", "sun", "Azimuth"),
    row("sun_elevation", "sun", "Elevation"),
    row("sun_size", "sun", "Disc size"),
    row("sky_strength", "sky", "Sky strength"),
    row("exposure", "camera", "Exposure"),
    row("strokes", "corrections", "Strokes", "data"),
    row("sun_hint", "corrections", "Sun in the photo", "data"),
  ],
  presets: [{ label: "Sunset", title: "", values: { sun_elevation: 2, exposure: 1 } }],
  versions: [{ name: "warm", recipe: { version: 1, exposure: 2, sun_size: 3 } }],
};
const stroke = {};

for (const [from, to, name] of [
  [{}, { sun_azimuth: 3, sun_elevation: 4 }, "Sun moved"],
  [{}, { sun_elevation: 4 }, "Sun elevation"],
  [{ sun_elevation: 4 }, {}, "Sun elevation"],
  [{}, { exposure: 1 }, "Camera exposure"],
  [{}, { sky_strength: 1 }, "Sky strength"],
  [{}, { sun_hint: [0, 0] }, "Sun in the photo"],
  [{}, { strokes: [stroke] }, "Stroke"],
  [{ strokes: [stroke, stroke] }, { strokes: [stroke] }, "Stroke erased"],
  [{ strokes: [stroke, stroke] }, {}, "Strokes erased"],
  [{}, { exposure: 2, sky_strength: 1 }, "Sky strength and camera exposure"],
  [{}, { sun_elevation: 2, exposure: 1, sun_azimuth: 1 }, "Sunset"],
  [{ sky_strength: 1 }, { exposure: 2, sun_size: 3 }, "“warm”"],
  [{ exposure: 2, sun_size: 3, sky_strength: 1 }, { version: 1 }, "Reset"],
  [{}, { sun_azimuth: 1, sun_elevation: 9, sun_size: 3 }, "Sun, 3 values"],
  [{}, { sun_azimuth: 1, sky_strength: 9, exposure: 3 }, "3 values"],
]) {
  test(`${JSON.stringify(from)} → ${JSON.stringify(to)} is called ${name}`, () => {
    assert.equal(stepName(from, to, known), name);
  });
}
