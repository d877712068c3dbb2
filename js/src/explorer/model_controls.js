/** Further controls of the models: Bruneton's table and the reference's progress. */

import { errorText } from "../host/error_text.js";
import { element } from "../ui/element.js";
import { MOST_SAMPLES } from "./limits.js";
import { SWITCHED_OFF } from "./values.js";

/** Display names of the models. @type {Record<string, string>} */
export const MODEL_NAMES = {
  none: "nothing",
  multiple: "All orders (Hillaire)",
  single: "Single (Nishita 1993)",
  bruneton: "Bruneton's table",
  reference: "Path tracing",
};

/**
 * @param {import("./types.js").Needs<"channel" | "frame" | "message" | "parameters" | "show" | "stage"
 *   | "state" | "tables" | "tracer">} view
 * @param {AbortSignal} signal
 */
export function modelControls(view, signal) {
  const { state } = view;
  const uses = (/** @type {string} */ model) =>
    state.values.model === model || state.values.compare === model;
  /** Parameters that Bruneton's table depends on: air, its switches, and orders. */
  const optical = view.parameters
    .filter(
      ({ name, section }) =>
        section === "air" || name in SWITCHED_OFF || name === "scattering_orders",
    )
    .map(({ name }) => name);
  const key = () => JSON.stringify(optical.map((name) => state.values[name]));
  let computed = "";
  let busy = false;
  /** Cost of the table as reported by the kernel, and for which air. @type {{ key: string, cached: boolean, seconds: number }} */
  let cost = { key: "", cached: false, seconds: 40 };
  let asking = "";
  const parameters = () =>
    Object.fromEntries(
      optical.filter((name) => name in state.values).map((name) => [name, state.values[name]]),
    );

  /** Ask for the cost of this air's table; fetch a cached one at once. */
  async function askCost() {
    const asked = key();
    if (asking === asked || busy || state.before !== null) return;
    asking = asked;
    try {
      const { result } = await view.channel.request("bruneton_cost", { parameters: parameters() });
      cost = { key: asked, cached: Boolean(result.cached), seconds: Number(result.seconds) };
    } catch {
      return; // without a kernel show the default cost
    }
    if (signal.aborted || asked !== key()) return;
    if (cost.cached && computed !== asked) await computeTable();
    else show();
  }

  const compute = element(
    "button",
    { type: "button", class: "sw-chip sw-primary" },
    "Compute table",
  );
  const explain = element("p", { class: "sw-hint" });
  const bruneton = element("div", { class: "sw-model-box", hidden: true }, explain, compute);
  compute.addEventListener("click", () => void computeTable());

  async function computeTable() {
    busy = true;
    const asked = key();
    show();
    view.message.show("");
    try {
      const { result, buffers } = await view.channel.request(
        "bruneton",
        { parameters: parameters() },
        (fraction, text) => view.stage.setProgress(fraction, text),
      );
      const { buffer, byteOffset, byteLength } = buffers[0];
      // A float view must start at a multiple of four bytes.
      const floats = new Float32Array(buffer.slice(byteOffset, byteOffset + byteLength));
      view.frame.setBruneton(floats, result.rows, result.cols);
      view.tables += 1;
      computed = asked;
    } catch (error) {
      if (signal.aborted) return;
      view.message.show(`Bruneton's table: ${errorText(error)}`);
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
    view.tracer.paused = !view.tracer.paused;
    view.show();
  });
  const reference = element(
    "div",
    { class: "sw-model-box", hidden: true },
    element(
      "p",
      { class: "sw-hint" },
      `Light is traced path by path, without approximation: noise fades as paths add up, and tracing ` +
        `stops at ${MOST_SAMPLES} paths per pixel. Any change starts over.`,
    ),
    pause,
  );

  function show() {
    bruneton.hidden = !uses("bruneton");
    reference.hidden = !uses("reference");
    const old = computed !== "" && computed !== key();
    compute.hidden = computed === key();
    compute.disabled = busy;
    const seconds = Math.max(1, Number(cost.seconds.toPrecision(2)));
    compute.textContent = busy ? "Computing …" : `Compute table (≈ ${seconds} s)`;
    if (uses("bruneton") && computed !== key()) void askCost();
    explain.textContent = !computed
      ? "This model looks everything up in one four-dimensional table, which the kernel computes once " +
        "per atmosphere: it is slow, so air sliders cannot be live. Until then all orders are shown."
      : old
        ? "The air has changed since the table was computed; the picture still shows the old air."
        : "The table fits this air. The sun can be dragged; another air or altitude needs a new table.";
    pause.textContent = view.tracer.paused ? "Resume" : "Pause";
  }

  return {
    nodes: [bruneton, reference],
    show,
    /** Text for the line under the sky. */
    note() {
      if (uses("reference")) {
        const samples = Math.min(view.frame.samples, MOST_SAMPLES);
        return `${samples} of ${MOST_SAMPLES} paths per pixel${view.tracer.paused ? ", paused" : ""}`;
      }
      if (uses("bruneton") && !computed) return "Bruneton's table is not computed yet";
      return "";
    },
  };
}
