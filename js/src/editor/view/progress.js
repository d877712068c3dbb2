/** Progress of the kernel's work, with buttons to cancel and to try again. */

import { element } from "../../ui/element.js";

/**
 * @type {import("../types.js").MakePart<"channel" | "kernel" | "model" | "notices" | "picture"
 *   | "stage" | "work">}
 */
export function progress({ channel, kernel, model, notices, picture, stage, work }, signal) {
  const cancel = element("button", { type: "button", class: "sw-progress-cancel" }, "Cancel");
  stage.progress.append(element("div", { class: "sw-progress-line" }, stage.caption, cancel));

  // Connection failures are reported by the part that watches the kernel.
  const ask = (/** @type {string} */ action) => channel.request(action).catch(() => kernel.check());

  cancel.addEventListener("click", () => {
    stage.caption.textContent = "Canceling …";
    cancel.disabled = true;
    if (work.busy) work.cancel();
    else void ask("cancel");
  });

  const again = { label: "Try again", run: () => void ask("retry") };
  /** @type {Record<string, () => string>} */
  const texts = {
    cancelled: () =>
      picture.scene
        ? "The correction was canceled: the picture does not show it yet."
        : "The analysis was canceled. A correction also restarts it.",
    error: () => "The analysis failed; the reason is below the picture.",
  };
  const show = () => {
    const at = model.get("_status")?.stage;
    cancel.disabled = false;
    if (at in texts && kernel.answers) {
      notices.show("analysis", { text: texts[at](), actions: [again] });
    } else notices.hide("analysis");
  };
  model.on("change:_status", show);
  signal.addEventListener("abort", () => model.off("change:_status", show));
  show();
  return {
    show() {
      cancel.disabled = false;
    },
  };
}
