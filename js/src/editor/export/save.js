/** Saves the picture: full size from the kernel, or preview size without one. */

import { download } from "../../ui/download.js";

/**
 * Add the toolbar's Save button and the menu item that saves the editor as a web page.
 *
 * @type {import("../types.js").MakePart<"channel" | "drawing" | "kernel" | "model" | "picture"
 *   | "stage" | "toolbar" | "work">}
 */
export function saving({ channel, drawing, kernel, model, picture, stage, toolbar, work }) {
  /**
   * Download a file that the kernel makes: the full-size picture, or a page.
   *
   * @param {"save" | "page"} action
   * @param {AbortSignal} signal
   */
  const fromKernel = async (action, signal) => {
    /** @type {import("../../host/channel.js").OnProgress} */
    const onProgress = (fraction, text) => {
      if (!signal.aborted) stage.setProgress(fraction, text);
    };
    onProgress(0, "Waiting for the kernel …");
    const asked = picture.requestContent();
    const { result, buffers } = await channel.request(action, asked, onProgress, [], signal);
    const bytes = /** @type {BlobPart} */ (buffers[0]);
    download(new Blob([bytes], { type: result.type }), result.name);
  };

  /** Download the canvas as PNG. */
  const preview = async () => {
    drawing.drawFrame(1);
    /** @type {Blob | null} */
    const blob = await new Promise((resolve) => stage.canvas.toBlob(resolve, "image/png"));
    if (!blob) throw new Error("the browser cannot encode the picture.");
    const { name = "picture" } = model.get("_source") ?? {};
    download(blob, `${name.replace(/\.[^.]*$/, "")}-sun.png`);
  };

  const save = () =>
    work.run("Saving", (signal) => (kernel.answers ? fromKernel("save", signal) : preview()));
  toolbar.save.addEventListener("click", () => void save());
  toolbar.menu.add({
    group: "picture",
    label: "Save as a web page",
    title: "One file in which the sun can be moved, without a notebook or network",
    enabled: () => kernel.answers && picture.scene !== null,
    shown: () => kernel.state !== "none",
    run: () => work.run("Saving the page", (signal) => fromKernel("page", signal)),
  });
  return {};
}
