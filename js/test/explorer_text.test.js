import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { literal, pythonCode } from "../src/explorer/code.js";
import { cssColor, daylight, xyzOfWavelength } from "../src/explorer/color.js";
import {
  depthOfTurbidity,
  depthOfVisibility,
  turbidity,
  visibility,
} from "../src/explorer/haze.js";
import { SPECTRAL_TO_XYZ, XYZ_TO_REC709 } from "../src/explorer/matrices.js";
import { errorColor, luminanceText, reading, relativeError } from "../src/explorer/sky_probe.js";

const near = (actual, expected, tolerance = 1e-9) =>
  assert.ok(Math.abs(actual - expected) <= tolerance, `${actual} is not ${expected}`);

// As the kernel sends them for Bodhaine's air.
const clean = {
  air_extinction_550: 1.1487e-5,
  mesosphere_altitude: 40000,
  mesosphere_share: 6500 / 8430,
  koschmieder: 3.912,
};
const air = {
  aerosol_optical_depth: 0.0645,
  air_density: 1,
  aerosol_scale_height: 1200,
  rayleigh_scale_height: 8430,
};

test("turbidity of clean air is one; both names come back to the optical depth", () => {
  near(turbidity(clean, { ...air, aerosol_optical_depth: 0 }), 1);
  for (const thicker of [air, { ...air, air_density: 0.7, rayleigh_scale_height: 7000 }]) {
    near(depthOfTurbidity(clean, thicker, turbidity(clean, thicker)), 0.0645);
    near(depthOfVisibility(clean, thicker, visibility(clean, thicker)), 0.0645);
  }
});

test("haze shortens the view and raises turbidity", () => {
  const hazy = { ...air, aerosol_optical_depth: 0.3 };
  assert.ok(visibility(clean, hazy) < visibility(clean, air));
  assert.ok(turbidity(clean, hazy) > turbidity(clean, air));
  assert.equal(depthOfTurbidity(clean, air, 0.5), 0);
});

test("code names what differs from the defaults, as Python writes it, and the sun", () => {
  assert.equal(
    pythonCode({ sun_elevation: 4.5, show_ozone: false, model: "single", ozone: 300 }, [0, 4.5]),
    "sw.SkyExplorer(show_ozone=False, model='single', ozone=300.0, sun_azimuth=0.0, sun_elevation=4.5)",
  );
  assert.equal(literal(null), "None");
  assert.equal(literal("it's"), "'it\\'s'");
});

test("a sun that time or scan bring along is not named", () => {
  assert.equal(
    pythonCode({ sun_elevation: 4.5, sun_azimuth: 3, time: 17.25, scan: 3 }, null),
    "sw.SkyExplorer(time=17.25, scan=3)",
  );
});

test("the matrices are the kernel's", () => {
  const path = new URL("../../sunwidget/atmosphere/constants.json", import.meta.url);
  const constants = JSON.parse(readFileSync(path, "utf-8"));
  assert.deepEqual(SPECTRAL_TO_XYZ, constants.spectral_to_xyz);
  assert.deepEqual(XYZ_TO_REC709, constants.xyz_to_rec709);
});

test("a grey spectrum of the sun is seen near daylight's white", () => {
  // Solar irradiance at the four wavelengths, as ASTM G-173 has it.
  const { xy, luminance } = reading([1.63, 1.84, 1.92, 1.83]);
  assert.ok(luminance > 100);
  assert.ok(Math.hypot(xy[0] - 0.324, xy[1] - 0.334) < 0.01, String(xy));
});

test("daylight of 6500 K is D65, wavelengths have their colours", () => {
  const [x, y] = daylight(6504);
  near(x, 0.3127, 5e-4);
  near(y, 0.3291, 5e-4);
  const [X, Y] = xyzOfWavelength(640);
  assert.ok(X > 2 * Y, "640 nm is red");
  near(Math.max(...[540, 550, 555, 560, 570].map((nm) => xyzOfWavelength(nm)[1])), 1, 0.03);
});

test("luminances are read in the unit that fits", () => {
  assert.equal(luminanceText(4.234), "4.23 kcd/m²");
  assert.equal(luminanceText(0.0123), "12.3 cd/m²");
  assert.equal(luminanceText(0.0000123), "12.3 mcd/m²");
});

test("an error has a sign, and a colour for it", () => {
  near(relativeError([2, 2, 2, 2], [1, 1, 1, 1]), 1);
  assert.equal(errorColor(0), "rgb(250 250 250)");
  assert.equal(errorColor(9), errorColor(0.5));
  assert.notEqual(errorColor(0.2), errorColor(-0.2));
});

test("a colour outside the gamut is brought inside", () => {
  assert.equal(cssColor([1, 1, 1]), "rgb(255 255 255)");
  assert.match(cssColor([-0.1, 0.5, 0.2]), /^rgb\(0 255 \d+\)$/);
});
