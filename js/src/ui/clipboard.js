/** Clipboard access, as far as the page allows it. */

import { element } from "./element.js";

/**
 * Copy text to the clipboard; returns whether that succeeded. A page without encryption has no
 * clipboard API but may copy the selection.
 *
 * @param {string} text
 */
export async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const field = element("textarea", { "aria-hidden": "true", class: "sw-away" });
    field.value = text;
    const focused = /** @type {HTMLElement | null} */ (document.activeElement);
    document.body.append(field);
    field.select();
    const done = document.execCommand("copy");
    field.remove();
    focused?.focus();
    return done;
  }
}

/** Return the clipboard's text, or null if the page may not read it. */
export async function readClipboard() {
  try {
    return await navigator.clipboard.readText();
  } catch {
    return null;
  }
}
