/** What the models need beyond a choice: Bruneton's table, and patience for the reference. */

import { element } from "../controls/element.js";
import { MOST_SAMPLES } from "./limits.js";

/** What people read in the choice of models. @type {Record<string, string>} */
export const MODEL_NAMES = {
  none: "nothing",
  multiple: "All orders (Hillaire 2020)",
  single: "Single scattering (Nishita 1993)",
  bruneton: "Bruneton's table (2008)",
  reference: "Path tracing (reference)",
};

/** The rows that Bruneton's table depends on. */
const OPTICAL = [
  "aerosol_optical_depth",
  "angstrom_exponent",
  "aerosol_asymmetry",
  "aerosol_albedo",
  "ozone",
  "ground_albedo",
  "altitude",
  "air_density",
  "rayleigh_exponent",
  "rayleigh_scale_height",
  "aerosol_scale_height",
  "scattering_orders",
  "show_rayleigh",
  "show_aerosol",
  "show_ozone",
];

/**
 * @param {import("./view.js").View} view
 * @param {AbortSignal} signal
 */
export function modelControls(view, signal) {
  const { state } = view;
  const uses = (/** @type {string} */ model) =>
    state.values.model === model || state.values.compare === model;
  const key = () => JSON.stringify(OPTICAL.map((name) => state.values[name]));
  let computed = "";
  let busy = false;

  const compute = element(
    "button",
    { type: "button", class: "sw-chip sw-primary" },
    "Compute table (≈ 40 s)",
  );
  const explain = element("p", { class: "sw-hint" });
  const bruneton = element("div", { class: "sw-model-box", hidden: true }, explain, compute);
  compute.addEventListener("click", () => void computeTable());

  async function computeTable() {
    busy = true;
    const asked = key();
    const parameters = Object.fromEntries(
      OPTICAL.filter((name) => name in state.values).map((name) => [name, state.values[name]]),
    );
    show();
    view.showError("");
    try {
      const { result, buffers } = await view.channel.request(
        "bruneton",
        { parameters },
        (fraction, text) => view.stage.setProgress(fraction, text),
      );
      const { buffer, byteOffset, byteLength } = buffers[0];
      // A view of floats has to begin at a multiple of four bytes.
      const floats = new Float32Array(buffer.slice(byteOffset, byteOffset + byteLength));
      view.frame.setBruneton(floats, result.rows, result.cols);
      view.tables += 1;
      computed = asked;
    } catch (error) {
      if (signal.aborted) return;
      view.showError(`Bruneton's table: ${error instanceof Error ? error.message : error}`);
    } finally {
      busy = false;
      if (!signal.aborted) {
        view.stage.setProgress(null, "");
        view.show();
      }
    }
  }

  const pause = element("button", { type: "button", class: "sw-chip" }, "Pause");
  pause.addEventListener("click", () => {
    view.paused = !view.paused;
    view.show();
  });
  const reference = element(
    "div",
    { class: "sw-model-box", hidden: true },
    element(
      "p",
      { class: "sw-hint" },
      `Light is followed path by path, without any shortcut: noise fades as paths add up, and at ` +
        `${MOST_SAMPLES} a pixel it rests. Any change starts anew.`,
    ),
    pause,
  );

  function show() {
    bruneton.hidden = !uses("bruneton");
    reference.hidden = !uses("reference");
    const old = computed !== "" && computed !== key();
    compute.hidden = computed === key();
    compute.disabled = busy;
    compute.textContent = busy ? "Computing …" : "Compute table (≈ 40 s)";
    explain.textContent = !computed
      ? "This model looks everything up in one table of four dimensions that the kernel computes once for " +
        "an atmosphere: slow to make, and no slider of the air can be dragged. Until then all orders are shown."
      : old
        ? "The air has changed since the table was computed; the picture still shows the old air."
        : "The table fits this air. The sun can be dragged; air and altitude need another table.";
    pause.textContent = view.paused ? "Go on" : "Pause";
  }

  return {
    nodes: [bruneton, reference],
    show,
    /** What the line under the sky says about it. */
    note() {
      if (uses("reference")) {
        const samples = Math.min(view.frame.samples, MOST_SAMPLES);
        return `${samples} of ${MOST_SAMPLES} paths a pixel${view.paused ? ", paused" : ""}`;
      }
      if (uses("bruneton") && !computed) return "Bruneton's table is not computed yet";
      return "";
    },
  };
}
