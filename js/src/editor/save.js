/** The picture as a file: of full size from the kernel, of preview size where none answers. */

import { download } from "./download.js";

/** @typedef {import("./view.js").View} View */

/**
 * The frame at full size, in the photo's own format.
 *
 * @param {View} view
 */
export async function saveFullSize(view) {
  const { result, buffers } = await view.channel.request("save", {}, (fraction, text) =>
    view.stage.setProgress(fraction, text),
  );
  download(new Blob([/** @type {BlobPart} */ (buffers[0])], { type: result.type }), result.name);
}

/**
 * The canvas as PNG.
 *
 * @param {View} view
 */
export async function savePreview(view) {
  view.drawFrame(1);
  const { canvas } = view.stage;
  /** @type {Blob | null} */
  const blob = await new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
  if (!blob) throw new Error("the browser cannot encode the picture");
  download(blob, `${view.model.get("_name") || "picture"}-sun.png`);
}
