/** Runs the export panel's exports and shows progress, result and name conflicts. */

import { chip } from "../../ui/chips.js";
import { download } from "../../ui/download.js";
import { element } from "../../ui/element.js";

const SHOWN_BYTES = 20_000_000; // as in sunwidget/widgets/editor/export_files.py

/**
 * @typedef {ReturnType<typeof exportJob>} Job
 * @typedef {{ name: string, type: string, bytes: number, files: number, path?: string }} Made
 */

/**
 * @param {import("../types.js").Needs<"channel" | "picture" | "stage" | "state" | "work">} needs
 * @param {() => boolean} isOpen whether the panel is open and so shows the progress itself
 * @param {AbortSignal} signal
 */
export function exportJob({ channel, picture, stage, state, work }, isOpen, signal) {
  const bar = element("progress", { max: 1, "aria-label": "Progress of the export" });
  const caption = element("span", { class: "sw-export-said" });
  const cancel = chip("Cancel", "Stop; no partial file is left", () => work.cancel());
  const running = element(
    "div",
    { class: "sw-export-running", hidden: true },
    bar,
    caption,
    cancel,
  );
  const done = element("div", { class: "sw-export-done", role: "status" });
  let url = "";
  const forget = () => {
    URL.revokeObjectURL(url);
    url = "";
  };
  signal.addEventListener("abort", forget);

  /** @param {number} fraction @param {string} text */
  const showProgress = (fraction, text) => {
    const open = isOpen();
    bar.value = fraction;
    caption.textContent = text;
    stage.setProgress(open ? null : fraction, open ? "" : text);
  };

  /** @param {Made} made @param {DataView[]} buffers @param {boolean} isFilm */
  const show = (made, buffers, isFilm) => {
    const blob = new Blob(/** @type {BlobPart[]} */ (buffers), { type: made.type });
    const { name, path } = made;
    if (!path) download(blob, name);
    forget();
    url = buffers.length ? URL.createObjectURL(blob) : "";
    const files = made.files > 1 ? `${made.files} files, ` : "";
    const text = element("p", {}, element("b", {}, name), ` · ${files}${sizeText(made.bytes)} · `);
    text.append(path ? `written to ${path}` : again(name));
    done.replaceChildren(text, ...(isFilm && made.bytes <= SHOWN_BYTES ? shown(made.type) : []));
  };
  const again = (/** @type {string} */ name) =>
    element("a", { href: url, download: name }, "download again");
  const shown = (/** @type {string} */ type) => {
    if (!url) return [];
    const node = type.startsWith("video/")
      ? element("video", { src: url, controls: true, loop: true, playsinline: true })
      : type.startsWith("image/")
        ? element("img", { src: url, alt: "The film" })
        : null;
    if (!node) return [];
    // The host may forbid it, or the browser may lack the codec.
    node.addEventListener("error", () => node.remove());
    return [node];
  };

  /**
   * Export once. If the name is taken, say so and offer a free one.
   *
   * @param {"still" | "film"} action
   * @param {{ name: string, [option: string]: unknown }} content
   * @param {(name: string) => void} rename receives the free name
   */
  const run = (action, content, rename) =>
    work.run("The export", async (stop) => {
      done.replaceChildren();
      running.hidden = false;
      showProgress(0, "Waiting for the kernel …");
      try {
        /** @type {import("../../host/channel.js").OnProgress} */
        const onProgress = (fraction, text) => {
          if (!stop.aborted) showProgress(fraction, text);
        };
        const asked = { ...content, ...picture.requestContent(), key_frames: state.keyFrames() };
        const { result, buffers } = await channel.request(action, asked, onProgress, [], stop);
        if (!result.taken) return show(result, buffers, action === "film");
        const other = chip(`Use ${result.free}`, "Export under this name", () => {
          rename(result.free);
          void run(action, { ...content, name: result.free }, rename);
        });
        const text = `${result.taken} already exists and was not overwritten.`;
        done.replaceChildren(element("p", {}, text), other);
      } finally {
        running.hidden = true;
      }
    });

  return { running, done, run };
}

/** @param {number} bytes */
export function sizeText(bytes) {
  if (bytes < 1e6) return `${Math.max(1, Math.round(bytes / 1e3))} kB`;
  return `${(bytes / 1e6).toFixed(bytes < 1e7 ? 1 : 0)} MB`;
}
