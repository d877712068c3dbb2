/** Shows the state of the kernel's work on the stage and in the message line. */

/** @param {import("../types.js").Needs<"message" | "model" | "root" | "stage">} needs */
export function showStatus({ message, model, root, stage }) {
  /** @type {import("../../host/types.js").Status | null} */
  const status = model.get("_status");
  if (!status) return;
  const working = status.stage === "opening" || status.stage === "analysing";
  stage.setProgress(working ? status.fraction : null, status.message);
  root.dataset.stage = status.stage;
  if (status.stage === "error") message.show(status.message);
  else if (status.stage === "ready") message.show("");
}
