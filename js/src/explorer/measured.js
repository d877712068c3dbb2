/** Measured skies: 81 directions over the dome, colored by the model's error. */

import { errorText } from "../host/error_text.js";
import { degrees } from "../ui/angle_text.js";
import { element, shape } from "../ui/element.js";
import { MODEL_LABELS } from "./guides.js";
import { ERROR_GRADIENT, errorColor, relativeError } from "./sky_probe.js";

/**
 * @typedef {import("../host/types.js").Point} Point
 * @typedef {{ time: string, sun_elevation: number, sun_azimuth: number, directions: Point[],
 *   radiance: number[][] }} Scan
 * @typedef {{ model: string, rmse: number, level: number, pattern: number }} Score
 */

const RADIUS = 5.5; // CSS pixels

export class Measured {
  /**
   * @param {import("./types.js").Needs<"drawnKey" | "model" | "placeOf" | "radiances" | "stage"
   *   | "state">} view
   */
  constructor(view) {
    this.view = view;
    this.dots = shape("g", { class: "sw-measured" });
    /** @type {SVGCircleElement[]} */
    this.circles = [];
    this.bar = element("span", { class: "sw-legend-bar" });
    this.bar.style.background = ERROR_GRADIENT;
    this.text = element("span", {});
    this.legend = element(
      "div",
      { class: "sw-error-legend", hidden: true },
      this.text,
      element("span", { class: "sw-error-scale" }, "−50 %", this.bar, "+50 %"),
    );
    /** @type {number | null} rms of the relative errors */
    this.rms = null;
    this.key = ""; // state that the dots were placed and colored for
    /** @type {Scan | null} scan of the current dots */
    this.drawn = null;
  }

  /** The scan shown. @returns {Scan | null} */
  scan() {
    const scan = this.view.model.get("_measured");
    return scan?.directions?.length && this.view.state.values.scan !== null ? scan : null;
  }

  draw() {
    const scan = this.scan();
    this.legend.hidden = !scan;
    if (!scan) {
      this.dots.replaceChildren();
      this.drawn = null;
      this.rms = null;
      return;
    }
    if (scan !== this.drawn) {
      this.drawn = scan;
      this.key = "";
      this.circles = scan.directions.map(() => {
        const circle = shape("circle", { r: RADIUS });
        circle.append(shape("title"));
        return circle;
      });
      this.dots.replaceChildren(...this.circles);
    }
    const box = this.view.stage.rectangle();
    const key = `${this.view.drawnKey} ${JSON.stringify(box)}`;
    if (key === this.key) return;
    this.key = key;
    const texels = this.view.radiances(scan.directions);
    let sum = 0;
    for (const [i, circle] of this.circles.entries()) {
      const place = this.view.placeOf(scan.directions[i]);
      const inside =
        place && place[0] >= 0 && place[1] >= 0 && place[0] <= box.width && place[1] <= box.height;
      circle.style.display = inside ? "" : "none";
      if (!texels) continue;
      const error = relativeError(texels.subarray(4 * i, 4 * i + 4), scan.radiance[i]);
      sum += error * error;
      if (!place || !inside) continue;
      circle.setAttribute("cx", String(box.x + place[0]));
      circle.setAttribute("cy", String(box.y + place[1]));
      circle.setAttribute("fill", errorColor(error));
      if (circle.firstChild) {
        const [azimuth, elevation] = scan.directions[i];
        circle.firstChild.textContent =
          `azimuth ${degrees(azimuth, 0)}, elevation ${degrees(elevation, 0)}: model ` +
          `${error < 0 ? "−" : "+"}${Math.abs(100 * error).toFixed(0)} %`;
      }
    }
    this.rms = Math.sqrt(sum / scan.directions.length);
    const model = MODEL_LABELS[String(this.view.state.values.model)];
    this.text.textContent = `${model} against the measured luminance, rms ${(100 * this.rms).toFixed(0)} %`;
  }
}

/**
 * Make the panel's controls: choose a scan, compute scores, or download the data.
 *
 * @param {import("./types.js").Needs<"channel" | "model" | "state">} view
 */
export function measuredControls(view) {
  const select = element("select", { class: "sw-select", "aria-label": "Measured scan" });
  select.addEventListener("change", () => {
    view.state.set({ scan: select.value === "" ? null : Number(select.value) });
  });
  const choose = element(
    "div",
    { class: "sw-choice sw-choice-wide" },
    element("span", { class: "sw-label" }, "Scan"),
    select,
  );
  const table = element("table", { class: "sw-scores", hidden: true });
  const compare = action("Compare models over all scans", async (progress) => {
    const { result } = await view.channel.request("rmse", { scan: null }, progress);
    fillScores(table, result.rows);
  });
  const explain = element(
    "p",
    { class: "sw-hint" },
    "15 scans of a clear day, 81 directions each, measured by Kider and others (2014), can be overlaid " +
      "on the sky. They are not part of the package: Download fetches them once from their public " +
      "repository to this computer.",
  );
  const question = element(
    "span",
    {},
    "Fetch the measured skies from github.com/spectralskylight/sky-measurements-2014?",
  );
  const fetchIt = action("Yes, download", async (progress) => {
    await view.channel.request("download_measurements", {}, progress);
    ask.hidden = true;
  });
  const no = element("button", { type: "button", class: "sw-chip" }, "No");
  const ask = element("div", { class: "sw-hint", hidden: true }, question, fetchIt.node, no);
  const download = element("button", { type: "button", class: "sw-chip" }, "Download …");
  download.addEventListener("click", () => {
    ask.hidden = false;
    download.hidden = true;
  });
  no.addEventListener("click", () => {
    ask.hidden = true;
    download.hidden = false;
  });
  const without = element("div", {}, explain, download, ask);
  const withData = element("div", {}, choose, compare.node, table);

  /** @param {string} label @param {(progress: import("../host/channel.js").OnProgress) => Promise<void>} work */
  function action(label, work) {
    const button = element("button", { type: "button", class: "sw-chip" }, label);
    const note = element("p", { class: "sw-hint", hidden: true, role: "status" });
    button.addEventListener("click", async () => {
      button.disabled = true;
      try {
        await work((_fraction, text) => {
          note.hidden = false;
          note.textContent = text;
        });
        note.hidden = true;
      } catch (error) {
        note.hidden = false;
        note.textContent = errorText(error);
      } finally {
        button.disabled = false;
      }
    });
    return { node: element("div", { class: "sw-action" }, button, note), button };
  }

  let listed = "";
  return {
    nodes: [without, withData],
    show() {
      /** @type {{ index: number, label: string, sun_elevation: number }[]} */
      const scans = view.model.get("_scans") ?? [];
      without.hidden = scans.length > 0;
      withData.hidden = scans.length === 0;
      const key = JSON.stringify(scans);
      if (key !== listed) {
        listed = key;
        select.replaceChildren(element("option", { value: "" }, "none"));
        for (const { index, label, sun_elevation } of scans) {
          const text = `${label}, sun ${degrees(sun_elevation, 0)}`;
          select.append(element("option", { value: index }, text));
        }
      }
      select.value = String(view.state.values.scan ?? "");
    },
  };
}

/** @type {(table: HTMLTableElement, rows: Score[]) => void} */
function fillScores(table, rows) {
  const cell = (/** @type {string} */ text) => element("td", {}, text);
  const head = ["Model", "RMSE", "Level", "Pattern"].map((text) => element("th", {}, text));
  const body = rows.map(({ model, rmse, level, pattern }) =>
    element(
      "tr",
      {},
      cell(MODEL_LABELS[model] ?? model),
      cell(rmse.toFixed(1)),
      cell(level.toFixed(2)),
      cell(`${(100 * pattern).toFixed(1)} %`),
    ),
  );
  table.replaceChildren(
    element(
      "caption",
      {},
      "RMSE in mW m⁻² sr⁻¹ nm⁻¹; level and pattern relative to the measured sky",
    ),
    element("tr", {}, ...head),
    ...body,
  );
  table.hidden = false;
}
