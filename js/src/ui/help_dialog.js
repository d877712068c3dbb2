/** The overlay that shows a table of shortcuts: a modal dialog, which the browser keeps the focus in. */

import { button } from "./button.js";
import { element } from "./element.js";
import { keyNames } from "./keys.js";

/**
 * @template V
 * @param {HTMLElement} root of the widget
 * @param {string} title
 * @param {readonly import("./keys.js").Shortcut<V>[]} shortcuts
 * @param {string} [note] what else there is to know
 */
export function openHelp(root, title, shortcuts, note = "") {
  const close = button({ icon: "close", label: "Close", onClick: () => dialog.close() });
  const heading = element("h2", { class: "sw-dialog-title" }, title);
  const sections = [...new Set(shortcuts.map(({ section }) => section))].map((name) =>
    element(
      "section",
      { class: "sw-keys", "aria-label": name },
      element("h3", {}, name),
      // No `dl`: notebooks lay that out as they like.
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
  // Keys belong to the dialog while it is open, and close it as they opened it.
  dialog.addEventListener("keydown", (event) => {
    event.stopPropagation();
    if (event.key === "?") dialog.close();
  });
  // The dialog's own box is covered by its content: what meets it is a click beside.
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
