/** Name and destination of an export, and the button that starts it. */

import { element } from "../../ui/element.js";
import { inputField, selectField } from "../../ui/named_field.js";

/**
 * What the kernel answers to "exports".
 *
 * @typedef {{ suffix: string, label: string, quality: boolean, bits?: number[], layers?: boolean,
 *   above_white?: boolean, lacks: string }} Format
 * @typedef {{ folder: string, name: string, suffix: string, bits: number,
 *   size: [number, number], stills: Format[], films: Format[] }} Choices
 */

/** @param {"still" | "film"} what @param {() => void} onExport */
export function exportTarget(what, onExport) {
  const name = inputField("Name", { type: "text", spellcheck: "false", autocomplete: "off" });
  const ending = element("span", { class: "sw-export-ending" });
  name.input.after(ending);
  name.node.classList.add("sw-export-name");
  const where = selectField("Save to", [
    ["download", "Download"],
    ["folder", "Notebook folder"],
  ]);
  const go = element("button", { type: "submit", class: "sw-chip sw-primary" }, "Export");
  go.setAttribute("aria-label", `Export the ${what}`); // another button opens the panel
  const hint = element("p", { class: "sw-hint" });
  const node = element("form", { class: "sw-export-target" }, name.node, where.node, go);
  let folder = "";
  const showFolder = () => {
    where.select.title = where.select.value === "folder" ? folder : "Download in the browser";
  };
  where.select.addEventListener("change", showFolder);
  node.addEventListener("submit", (event) => {
    event.preventDefault();
    if (!go.disabled) onExport();
  });
  return {
    node,
    hint,
    /** The fields' part of the request to the kernel. */
    content: () => ({ name: name.input.value, in_folder: where.select.value === "folder" }),
    /** @param {string} text a file name with the format's ending */
    rename(text) {
      const end = ending.textContent ?? "";
      name.input.value = end && text.endsWith(end) ? text.slice(0, -end.length) : text;
    },
    /** @param {Choices} choices */
    take(choices) {
      folder = choices.folder;
      if (!name.input.value) name.input.value = choices.name;
      showFolder();
    },
    /** @param {string} suffix @param {string} problem why nothing can be exported, or "" */
    show(suffix, problem) {
      ending.textContent = suffix;
      go.disabled = problem !== "";
      hint.textContent = problem;
      hint.hidden = problem === "";
    },
  };
}

/** Convert formats to select options. @param {Format[]} formats @returns {[string, string][]} */
export const formatOptions = (formats) => formats.map(({ suffix, label }) => [suffix, label]);

/** Return how to install what a format needs, or "". @param {Format | undefined} format */
export const lacking = (format) =>
  format?.lacks ? `${format.label} needs more: ${format.lacks}, then restart the kernel.` : "";
