import assert from "node:assert/strict";
import { test } from "node:test";
import { effectiveValues } from "../src/explorer/values.js";

const number = (name, value) => ({ name, kind: "number", default: value });
const flag = (name) => ({ name, kind: "switch", default: true });
const parameters = [
  number("sun_elevation", 20),
  number("air_density", 1),
  number("aerosol_optical_depth", 0.0645),
  number("ozone", 300),
  number("scattering_orders", 0),
  flag("show_rayleigh"),
  flag("show_aerosol"),
  flag("show_ozone"),
  flag("show_single"),
  { name: "model", kind: "choice", default: "multiple", choices: ["multiple", "single"] },
  { name: "date", kind: "data", default: null },
];

test("switches are 0 or 1, choices their index, data no uniform", () => {
  const { edit } = effectiveValues(parameters, { show_single: false, model: "single" });
  assert.equal(edit.show_single, 0);
  assert.equal(edit.show_ozone, 1);
  assert.equal(edit.model, 1);
  assert.ok(!("date" in edit));
});

test("a term that is off is an atmosphere without it", () => {
  for (const [name, silenced] of [
    ["show_rayleigh", "air_density"],
    ["show_aerosol", "aerosol_optical_depth"],
    ["show_ozone", "ozone"],
  ]) {
    const { edit, single } = effectiveValues(parameters, { [name]: false });
    assert.equal(edit[silenced], 0);
    assert.equal(single[silenced], 0);
  }
  assert.equal(effectiveValues(parameters, {}).edit.ozone, 300);
});

test("the single state and the single model scatter once", () => {
  const { edit, single } = effectiveValues(parameters, { scattering_orders: 4 });
  assert.deepEqual([edit.scattering_orders, single.scattering_orders], [4, 1]);
  const { edit: once } = effectiveValues(parameters, { scattering_orders: 4, model: "single" });
  assert.equal(once.scattering_orders, 1);
  const beside = effectiveValues(parameters, {
    scattering_orders: 4,
    model: "single",
    compare: "multiple",
  });
  assert.equal(beside.edit.scattering_orders, 4);
});
