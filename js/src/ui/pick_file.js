/** Ask the person for a file. */

import { element } from "./element.js";

/**
 * @param {string} accept as the attribute of a file input
 * @param {AbortSignal} signal
 * @returns {Promise<File | null>} null when none was chosen
 */
export function pickFile(accept, signal) {
  return new Promise((resolve) => {
    const input = element("input", { type: "file", accept });
    input.addEventListener("change", () => resolve(input.files?.[0] ?? null), { signal });
    input.addEventListener("cancel", () => resolve(null), { signal });
    input.click();
  });
}
