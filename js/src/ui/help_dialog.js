/** A modal dialog with a table of shortcuts. */

import { button } from "./button.js";
import { element } from "./element.js";
import { keyNames } from "./keys.js";

/**
 * @template V
 * @param {HTMLElement} root of the widget
 * @param {string} title
 * @param {readonly import("./keys.js").Shortcut<V>[]} shortcuts
 * @param {string} [note] additional text
 */
export function openHelp(root, title, shortcuts, note = "") {
  const close = button({ icon: "close", label: "Close", onClick: () => dialog.close() });
  const heading = element("h2", { class: "sw-dialog-title" }, title);
  const sections = [...new Set(shortcuts.map(({ section }) => section))].map((name) =>
    element(
      "section",
      { class: "sw-keys", "aria-label": name },
      element("h3", {}, name),
      // Not `dl`: notebooks style it their own way.
      element(
        "div",
        { role: "list" },
        ...shortcuts.filter(({ section }) => section === name).map(row),
      ),
    ),
  );
  const dialog = element(
    "dialog",
    { class: "sw-dialog", "aria-label": title },
    element("div", { class: "sw-dialog-head" }, heading, close),
    element("div", { class: "sw-dialog-body", tabindex: 0 }, ...sections),
    ...(note ? [element("p", { class: "sw-dialog-note" }, note)] : []),
  );
  // The open dialog handles all keys; the key that opened it also closes it.
  dialog.addEventListener("keydown", (event) => {
    event.stopPropagation();
    if (event.key === "?") dialog.close();
  });
  // The content covers the dialog's box, so a click on the dialog itself is outside.
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
  dialog.addEventListener("close", () => dialog.remove());
  root.append(dialog);
  dialog.showModal();
}

/** @template V @param {import("./keys.js").Shortcut<V>} shortcut */
function row({ keys, label }) {
  const key = (/** @type {string} */ name) => element("kbd", { class: "sw-key" }, name);
  /** @type {(Node | string)[]} */
  const combinations = keys.flatMap((each, i) => [
    ...(i ? [" "] : []),
    element("span", {}, ...keyNames(each).map(key)),
  ]);
  return element(
    "div",
    { class: "sw-keys-row", role: "listitem" },
    element("span", {}, label),
    element("span", { class: "sw-combinations" }, ...combinations),
  );
}
