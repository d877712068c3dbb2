/** The clipboard, as far as the page has one. */

import { element } from "./element.js";

/**
 * Put text on the clipboard; returns whether it got there. A page that came without encryption has
 * no clipboard of its own, but may copy what is selected.
 *
 * @param {string} text
 */
export async function copied(text) {
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

/** What is on the clipboard, or null where the page may not look. */
export async function pasted() {
  try {
    return await navigator.clipboard.readText();
  } catch {
    return null;
  }
}
