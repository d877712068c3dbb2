/** The picture as a file: of full size from the kernel, of preview size where none answers. */

import { Cancelled } from "../channel.js";
import { download } from "./download.js";

/** @typedef {import("./view.js").View} View */

/**
 * Hand the picture to the person. `view.work` cancels it while it is made.
 *
 * @param {View} view
 */
export async function save(view) {
  if (view.work) return;
  const work = new AbortController();
  view.work = work;
  view.state.push();
  view.toolbar.show();
  try {
    await (view.kernel.answers ? saveFullSize(view, work.signal) : savePreview(view));
    view.notices.hide("save");
  } catch (error) {
    const why = error instanceof Error ? error.message : String(error);
    const text = error instanceof Cancelled ? "Saving was cancelled." : `Saving failed: ${why}`;
    view.notices.show("save", { text, actions: [{ label: "Try again", run: () => save(view) }] });
  } finally {
    view.work = null;
    view.stage.setProgress(null, "");
    view.toolbar.show();
  }
}

/**
 * The frame at full size, in the photo's own format.
 *
 * @param {View} view
 * @param {AbortSignal} signal
 */
async function saveFullSize({ channel, stage }, signal) {
  /** @type {import("../channel.js").OnProgress} */
  const onProgress = (fraction, text) => {
    if (!signal.aborted) stage.setProgress(fraction, text);
  };
  onProgress(0, "Asking the kernel …");
  const { result, buffers } = await channel.request("save", {}, onProgress, [], signal);
  download(new Blob([/** @type {BlobPart} */ (buffers[0])], { type: result.type }), result.name);
}

/**
 * The canvas as PNG.
 *
 * @param {View} view
 */
async function savePreview(view) {
  view.drawFrame(1);
  const { canvas } = view.stage;
  /** @type {Blob | null} */
  const blob = await new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
  if (!blob) throw new Error("the browser cannot encode the picture.");
  const { name = "picture" } = view.model.get("_source") ?? {};
  download(blob, `${name.replace(/\.[^.]*$/, "")}-sun.png`);
}
