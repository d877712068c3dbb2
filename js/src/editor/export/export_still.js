/** The export panel's still page: format, depth, quality, size, light above white, layers. */

import { element } from "../../ui/element.js";
import { inputField, selectField } from "../../ui/named_field.js";
import { toggle } from "../../ui/toggle.js";
import { exportTarget, formatOptions, lacking } from "./export_target.js";

/** @type {Record<number, string>} */
const BITS = { 8: "8 bits", 16: "16 bits", 32: "32 bits, linear" };
const PREVIEW = 2048; // longer side of the browser's preview, pixels

/**
 * @param {import("../types.js").Needs<"kernel" | "picture">} needs
 * @param {import("./export_job.js").Job} job
 */
export function exportStill({ kernel, picture }, job) {
  /** @type {import("./export_target.js").Choices | null} */
  let choices = null;
  let layersOn = false;
  let brighterOn = false;
  const format = selectField("Format");
  const bits = selectField("Depth");
  const quality = inputField("Quality", { type: "number", min: 1, max: 100, value: 95 });
  const size = selectField("Size");
  const edge = inputField("Longer side, pixels", { type: "number", min: 16, value: 1600 });
  const layers = toggle({
    parameter: {
      name: "",
      label: "Layers",
      help: "Also write sky, clouds, land and matte as layers for an image editor",
      default: false,
    },
    onChange: (on) => {
      layersOn = on;
      show();
    },
  });

  const brighter = toggle({
    parameter: {
      name: "",
      label: "Light above white",
      help: "HDR: screens that can do so show the moved sun and its glitter brighter than white",
      default: false,
    },
    onChange: (on) => {
      brighterOn = on;
      show();
    },
  });

  const chosen = () => choices?.stills.find(({ suffix }) => suffix === format.select.value);
  const longEdge = () => {
    if (size.select.value === "full") return null;
    return size.select.value === "preview" ? PREVIEW : Math.round(Number(edge.input.value));
  };
  const target = exportTarget("still", () => {
    if (![quality, edge].every(({ node, input }) => node.hidden || input.reportValidity())) return;
    const content = {
      ...target.content(),
      suffix: format.select.value,
      bits: Number(bits.select.value),
      quality: Number(quality.input.value),
      long_edge: longEdge(),
      layers: layersOn,
      above_white: brighterOn,
    };
    void job.run("still", content, (name) => target.rename(name));
  });
  const node = element(
    "div",
    { class: "sw-export-page" },
    element(
      "div",
      { class: "sw-export-fields" },
      ...[format, bits, quality, size, edge, brighter, layers].map((field) => field.node),
    ),
    target.node,
    target.hint,
  );

  /** Offer the format's bit depths, the photo's own first if available. */
  const offerBits = () => {
    const depths = chosen()?.bits ?? [];
    bits.setOptions(depths.map((depth) => [String(depth), BITS[depth]]));
    bits.select.value = String(depths.includes(choices?.bits ?? 0) ? choices?.bits : depths[0]);
  };
  const show = () => {
    const kind = chosen();
    bits.node.hidden = (kind?.bits?.length ?? 0) < 2;
    quality.node.hidden = !kind?.quality;
    layers.node.hidden = !kind?.layers;
    brighter.node.hidden = !kind?.above_white;
    edge.node.hidden = size.select.value !== "edge";
    layers.show(layersOn);
    brighter.show(brighterOn);
    target.show(kind?.suffix ?? "", problem(kind));
  };
  const problem = (/** @type {import("./export_target.js").Format | undefined} */ kind) => {
    if (!kernel.answers) return "Needs the kernel: run the cell again.";
    if (!picture.scene) return "The photo has not been analyzed yet.";
    return lacking(kind);
  };
  format.select.addEventListener("change", () => {
    offerBits();
    show();
  });
  size.select.addEventListener("change", show);

  return {
    node,
    show,
    /** @param {import("./export_target.js").Choices} found */
    take(found) {
      const first = choices === null;
      choices = found;
      const [width, height] = found.size;
      format.setOptions(formatOptions(found.stills));
      const small = Math.max(width, height) <= PREVIEW;
      size.setOptions([
        ["full", `Full, ${width} × ${height}`],
        ...(small ? [] : /** @type {[string, string][]} */ ([["preview", `Preview, ${PREVIEW}`]])),
        ["edge", "Longer side …"],
      ]);
      edge.input.max = String(Math.max(width, height));
      if (first) {
        format.select.value = found.suffix;
        offerBits();
        edge.input.value = String(Math.min(1600, Math.max(width, height)));
      }
      target.take(found);
      show();
    },
  };
}
