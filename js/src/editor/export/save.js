/** The picture as a file: of full size from the kernel, of preview size where none answers. */

import { download } from "../../ui/download.js";

/** @typedef {import("../view/view.js").View} View */

/**
 * Hand the picture to the person as a file.
 *
 * @param {View} view
 */
export const save = (view) =>
  view.work.run("Saving", (signal) =>
    view.kernel.answers ? fromKernel(view, "save", signal) : savePreview(view),
  );

/** The editor itself as a file. @type {import("../parts.js").MakePart} */
export function webPage(view) {
  view.toolbar.menu.add({
    group: "picture",
    label: "Save as a web page",
    title: "One file in which the sun can be moved, without a notebook and without network",
    enabled: () => view.kernel.answers && view.picture.scene !== null,
    shown: () => view.kernel.state !== "none",
    run: () => view.work.run("Saving the page", (signal) => fromKernel(view, "page", signal)),
  });
  return {};
}

/**
 * A file that the kernel makes: the frame at full size, or a page.
 *
 * @param {View} view
 * @param {"save" | "page"} action
 * @param {AbortSignal} signal
 */
async function fromKernel(view, action, signal) {
  const { channel, stage } = view;
  /** @type {import("../../host/channel.js").OnProgress} */
  const onProgress = (fraction, text) => {
    if (!signal.aborted) stage.setProgress(fraction, text);
  };
  onProgress(0, "Asking the kernel …");
  const { result, buffers } = await channel.request(
    action,
    view.picture.asked(),
    onProgress,
    [],
    signal,
  );
  download(new Blob([/** @type {BlobPart} */ (buffers[0])], { type: result.type }), result.name);
}

/**
 * The canvas as PNG.
 *
 * @param {View} view
 */
async function savePreview(view) {
  view.drawing.drawFrame(1);
  const { canvas } = view.stage;
  /** @type {Blob | null} */
  const blob = await new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
  if (!blob) throw new Error("the browser cannot encode the picture.");
  const { name = "picture" } = view.model.get("_source") ?? {};
  download(blob, `${name.replace(/\.[^.]*$/, "")}-sun.png`);
}
