/** Receives errors that the kernel reports outside requests. */

/**
 * @param {import("./types.js").Model} model
 * @param {(text: string) => void} show
 * @param {AbortSignal} signal ends it
 */
export function onKernelError(model, show, signal) {
  /** @type {(message: any) => void} */
  const onMessage = (message) => {
    if (message?.type === "error") show(message.error);
  };
  model.on("msg:custom", onMessage);
  signal.addEventListener("abort", () => model.off("msg:custom", onMessage));
}
