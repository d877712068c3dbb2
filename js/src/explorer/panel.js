/** The panel: sun, place and time, terms, air, model, view, measured skies. */

import { chip, presetChips } from "../ui/chips.js";
import { choice } from "../ui/choice.js";
import { element } from "../ui/element.js";
import { section } from "../ui/section.js";
import { slider } from "../ui/slider.js";
import { toggle } from "../ui/toggle.js";
import { depthOfTurbidity, depthOfVisibility, turbidity, visibility } from "./haze.js";
import { measuredControls } from "./measured.js";
import { MODEL_NAMES, modelControls } from "./model_controls.js";
import { placeControls } from "./place.js";

/** @typedef {import("../host/types.js").Parameter} Parameter */

const AIR = [
  "aerosol_optical_depth",
  "angstrom_exponent",
  "aerosol_asymmetry",
  "aerosol_albedo",
  "aerosol_scale_height",
  "ozone",
  "air_density",
  "rayleigh_exponent",
  "rayleigh_scale_height",
  "ground_albedo",
  "altitude",
];
const TERMS = ["show_rayleigh", "show_aerosol", "show_ozone", "show_single", "show_multiple"];
/** Colors shared by switches and the plots' lines. @type {Record<string, string>} */
const COLORS = {
  show_rayleigh: "var(--sw-rayleigh)",
  show_aerosol: "var(--sw-aerosol)",
  show_ozone: "var(--sw-ozone)",
};
/** Times of day as sun elevations. @type {[string, number, string][]} */
const HOURS = [
  ["Noon", 60, "Sun at 60°"],
  ["Golden hour", 4, "Sun at 4°"],
  ["Sunset", 0, "Sun at the horizon"],
  ["Blue hour", -6, "Sun at −6°"],
];

/**
 * @param {import("./types.js").Needs<"channel" | "clamp" | "frame" | "message" | "model" | "number"
 *   | "parameter" | "parameters" | "show" | "stage" | "state" | "sun" | "tables" | "tracer">} view
 * @param {AbortSignal} signal
 */
export function panel(view, signal) {
  const { state } = view;
  /** @type {(() => void)[]} */
  const updates = [];

  /** @param {Parameter} p @returns {HTMLElement} */
  const row = (p) => {
    if (p.kind === "choice") {
      const control = choice({
        parameter: p,
        names: p.name === "model" || p.name === "compare" ? MODEL_NAMES : {},
        onChange: (value) => state.set({ [p.name]: value }),
      });
      updates.push(() => control.show(String(state.values[p.name] ?? p.default)));
      return control.node;
    }
    if (p.kind === "switch") {
      const control = toggle({
        parameter: p,
        color: COLORS[p.name],
        onChange: (on) => state.set({ [p.name]: on }),
      });
      updates.push(() => control.show(Boolean(state.values[p.name] ?? p.default)));
      return control.node;
    }
    const moves = p.name === "sun_elevation" || p.name === "sun_azimuth";
    const control = slider({
      parameter: p,
      onBegin: () => state.begin(),
      onInput: (value) => {
        if (!moves) return state.set({ [p.name]: value });
        const [azimuth, elevation] = view.sun.direction();
        if (p.name === "sun_azimuth") return view.sun.moveTo(Number(value), elevation);
        return view.sun.moveTo(azimuth, Number(value));
      },
      onCommit: () => state.commit(),
    });
    updates.push(() => control.show(view.number(p.name), undefined));
    return control.node;
  };
  /** Rows that the kernel's table has. @param {string[]} names */
  const rows = (...names) =>
    names.flatMap((name) => view.parameters.filter((p) => p.name === name)).map(row);

  const place = placeControls(view, signal);
  const models = modelControls(view, signal);
  const measured = measuredControls(view);
  const presets = presetChips(state, () => atmospheres(view));
  const aliases = aliasSliders(view);
  updates.push(place.show, models.show, measured.show, presets.show, aliases.show);

  const camera = rows("view_elevation", "fov");
  const node = element(
    "div",
    { class: "sw-panel", role: "group", "aria-label": "Parameters" },
    presets.node,
    section({ title: "Sun" }, hours(view), ...rows("sun_elevation", "sun_azimuth", "sun_size")),
    section({ title: "Place and time", open: false }, ...place.nodes),
    section({ title: "Terms" }, ...rows(...TERMS)),
    section({ title: "Air" }, ...aliases.nodes, ...rows(...AIR)),
    section(
      { title: "Model" },
      ...rows("model", "compare", "scattering_orders", "grid"),
      ...models.nodes,
    ),
    section(
      { title: "View", open: false },
      ...rows("view_azimuth"),
      ...camera,
      ...rows("exposure", "auto_exposure"),
    ),
    section({ title: "Measured", open: false }, ...measured.nodes),
  );
  updates.push(() => {
    for (const control of camera) control.hidden = state.values.projection !== "camera";
  });
  return {
    node,
    note: models.note,
    show: () => {
      for (const update of updates) update();
    },
  };
}

/** @param {import("./types.js").Needs<"sun">} view */
function hours(view) {
  const chips = HOURS.map(([label, elevation, title]) =>
    chip(label, title, () => view.sun.moveTo(view.sun.direction()[0], elevation)),
  );
  return element("div", { class: "sw-chips" }, ...chips);
}

/** Atmospheres by name. @param {import("./types.js").Needs<"model">} view */
function atmospheres(view) {
  /** @type {Record<string, Record<string, number>>} */
  const presets = view.model.get("_presets") ?? {};
  return Object.entries(presets).map(([name, values]) => {
    const label = name[0].toUpperCase() + name.slice(1).replaceAll("_", " ");
    return { label, title: `Air: ${label}`, values };
  });
}

/**
 * Make sliders for turbidity and visibility, which also set the haze's optical depth.
 *
 * @param {import("./types.js").Needs<"clamp" | "model" | "parameter" | "parameters" | "state">} view
 */
function aliasSliders(view) {
  const clean = /** @type {import("./haze.js").CleanAir} */ (view.model.get("_aliases"));
  const depth = view.parameter("aerosol_optical_depth");
  const air = (/** @type {Record<string, unknown>} */ changes = {}) =>
    /** @type {import("./haze.js").Air} */ (
      /** @type {unknown} */ ({ ...view.state.values, ...changes })
    );
  const most = { aerosol_optical_depth: depth.maximum };
  const standard = { ...Object.fromEntries(view.parameters.map((p) => [p.name, p.default])) };
  /** @type {{ name: string, label: string, unit: string, step: number, help: string, of: (a: any) => number, depthOf: (value: number) => number, span: () => [number, number] }[]} */
  const table = [
    {
      name: "turbidity",
      label: "Turbidity",
      unit: "",
      step: 0.1,
      help: "Optical depth of hazy air over that of clean air (550 nm). Changes the optical depth of the haze.",
      of: (a) => turbidity(clean, a),
      depthOf: (value) => depthOfTurbidity(clean, air(), value),
      span: () => [1, turbidity(clean, air(most))],
    },
    {
      name: "visibility",
      label: "Visibility",
      unit: "km",
      step: 1,
      help: "How far a dark hill can be seen at sea level: 3.912 over the extinction at 550 nm. Changes the optical depth of the haze.",
      of: (a) => visibility(clean, a) / 1000,
      depthOf: (value) => depthOfVisibility(clean, air(), 1000 * value),
      span: () => [
        visibility(clean, air(most)) / 1000,
        visibility(clean, air({ aerosol_optical_depth: 0 })) / 1000,
      ],
    },
  ];
  const controls = table.map((alias) => {
    const [minimum, maximum] = alias.span();
    /** @type {any} */
    const parameter = {
      ...alias,
      kind: "number",
      default: alias.of(standard),
      minimum,
      maximum: Number.isFinite(maximum) ? maximum : 1000,
    };
    const control = slider({
      parameter,
      onBegin: () => view.state.begin(),
      onInput: (value) => {
        const wanted = alias.depthOf(Number(value));
        view.state.set({ aerosol_optical_depth: view.clamp("aerosol_optical_depth", wanted) });
      },
      onCommit: () => view.state.commit(),
    });
    return { node: control.node, show: () => control.show(alias.of(air()), undefined) };
  });
  return {
    nodes: controls.map((control) => control.node),
    show: () => {
      for (const control of controls) control.show();
    },
  };
}
