/** Opens a photo or a recipe that is dropped, pasted or chosen. */

import { errorText } from "../../host/error_text.js";
import { element } from "../../ui/element.js";
import { pickFile } from "../../ui/pick_file.js";
import { loadRecipe } from "../recipe/recipe.js";
import { showStatus } from "./status.js";

/**
 * @typedef {import("../types.js").Needs<"channel" | "kernel" | "message" | "model" | "notices"
 *   | "root" | "stage" | "state">} Taker
 */

const CHUNK = 4_000_000; // bytes: a message of 10 MiB would break the connection
const PHOTOS = "image/*,.tif,.tiff,.heic,.avif";
const RECIPE = /\.(json|py|txt)$/i;

/**
 * @type {import("../types.js").MakePart<"channel" | "kernel" | "message" | "model" | "notices"
 *   | "root" | "stage" | "state" | "toolbar">}
 */
export function drop({ toolbar, ...taker }, signal) {
  const { kernel, root } = taker;
  const veil = element(
    "div",
    { class: "sw-drop", "aria-hidden": "true" },
    element("span", {}, "Drop a photo or a recipe"),
  );
  root.append(veil);
  let inside = 0; // depth: a child's dragenter precedes its parent's dragleave
  /** @param {number} depth */
  const enter = (depth) => {
    inside = depth;
    root.classList.toggle("sw-dropping", inside > 0);
  };
  /** @type {Record<string, (event: DragEvent) => void>} */
  const handlers = {
    dragenter: () => enter(inside + 1),
    dragleave: () => enter(Math.max(0, inside - 1)),
    dragover: (event) => event.preventDefault(),
    drop: (event) => {
      enter(0);
      event.preventDefault();
      // Keep it from JupyterLab, which would upload it into its folder.
      event.stopPropagation();
      const file = event.dataTransfer?.files[0];
      if (file) void take(taker, file);
    },
  };
  for (const [name, handler] of Object.entries(handlers)) {
    root.addEventListener(
      name,
      (event) => {
        const drag = /** @type {DragEvent} */ (event);
        if (drag.dataTransfer?.types.includes("Files")) handler(drag);
      },
      { signal },
    );
  }
  root.addEventListener(
    "paste",
    (event) => {
      const file = event.clipboardData?.files[0];
      if (!file) return;
      event.preventDefault();
      event.stopImmediatePropagation();
      void take(taker, file);
    },
    { signal },
  );
  toolbar.menu.add({
    group: "photo",
    label: "Open photo …",
    title: "Open another photo in this editor; the current edit is set aside",
    enabled: () => kernel.answers,
    run: async () => {
      const file = await pickFile(PHOTOS, signal);
      if (file) await take(taker, file);
    },
  });
  return {};
}

/** @param {Taker} taker @param {File} file */
async function take(taker, file) {
  try {
    if (RECIPE.test(file.name)) await loadRecipe(taker, file);
    else await upload(taker, file);
  } catch (error) {
    taker.message.show(`${file.name} could not be opened: ${errorText(error)}`);
  }
}

/**
 * Upload a photo to the kernel in chunks; it returns a preview.
 *
 * @param {Taker} taker
 * @param {File} file
 */
async function upload(taker, file) {
  const { channel, kernel, message, stage, state } = taker;
  if (!kernel.answers) {
    throw new Error("this needs the kernel, which is not running. Run the cell again.");
  }
  state.commit();
  message.show("");
  const key = crypto.randomUUID?.() ?? String(Math.random());
  const { name, size } = file;
  try {
    let offset = 0;
    do {
      const piece = await file.slice(offset, offset + CHUNK).arrayBuffer();
      stage.setProgress(offset / Math.max(1, size), "Uploading …");
      await channel.request("upload", { upload: key, name, size, offset }, undefined, [piece]);
      offset += piece.byteLength;
    } while (offset < size);
  } catch (error) {
    showStatus(taker);
    throw error;
  }
}
