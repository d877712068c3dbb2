import assert from "node:assert/strict";
import { test } from "node:test";
import { stepName } from "../src/edit/step_names.js";

const row = (name, section, label, kind = "number", value = null) => ({
  name,
  section,
  label,
  kind,
  default: value,
});
// As the kernel's presets: all of them set the same values, defaults too.
const preset = (sun_elevation, others) => ({
  sun_azimuth: 1,
  sun_elevation,
  light_source: "sun",
  exposure: 0,
  ...others,
});
const known = {
  parameters: [
    row("sun_azimuth", "sun", "Azimuth"),
    row("sun_elevation", "sun", "Elevation"),
    row("sun_size", "sun", "Disc size"),
    row("sky_strength", "sky", "Sky strength"),
    row("light_source", "sun", "Light", "choice", "sun"),
    row("exposure", "camera", "Exposure", "number", 0),
    row("strokes", "corrections", "Strokes", "data"),
    row("sun_hint", "corrections", "Sun in the photo", "data"),
  ],
  presets: [
    { label: "Sunset", title: "", values: preset(2, { exposure: 1 }) },
    { label: "Dawn", title: "", values: preset(-3, {}) },
    { label: "Noon", title: "", values: preset(55, { future: 1 }) },
    { label: "Moonlight", title: "", values: preset(18, { light_source: "moon" }) },
  ],
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
  [{}, { sun_elevation: -3, sun_azimuth: 1 }, "Dawn"],
  [{ sun_elevation: -3, sun_azimuth: 1 }, { sun_elevation: 55, sun_azimuth: 1 }, "Noon"],
  [{ exposure: 3 }, { sun_elevation: 18, sun_azimuth: 1, light_source: "moon" }, "Moonlight"],
  [
    { sun_elevation: -3, sun_azimuth: 1 },
    { sun_elevation: -3, sun_azimuth: 1, strokes: [stroke] },
    "Stroke",
  ],
  [
    { sun_elevation: 55, sun_azimuth: 1, sky_strength: 1 },
    { sun_elevation: 55, sun_azimuth: 1, sun_size: 3 },
    "Sun disc size and sky strength",
  ],
  [{ sky_strength: 1 }, { exposure: 2, sun_size: 3 }, "“warm”"],
  [{ exposure: 2, sun_size: 3, sky_strength: 1 }, { version: 1 }, "Reset"],
  [{}, { sun_azimuth: 1, sun_elevation: 9, sun_size: 3 }, "Sun, 3 values"],
  [{}, { sun_azimuth: 1, sky_strength: 9, exposure: 3 }, "3 values"],
]) {
  test(`${JSON.stringify(from)} → ${JSON.stringify(to)} is called ${name}`, () => {
    assert.equal(stepName(from, to, known), name);
  });
}
