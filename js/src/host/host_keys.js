/**
 * Keys that are pressed in a widget are the widget's: JupyterLab would insert cells at them. Only
 * the one that saves the notebook stays the host's. And none is lost with the focus.
 */

const MARK = "data-lm-suppress-shortcuts";

/**
 * JupyterLab passes over what is marked, and what is inside of it; but it looks at the focused
 * element before it looks at what that is inside of, and some of its shortcuts ask only for a focus
 * within the notebook. So whatever gets the focus is marked too.
 *
 * @param {HTMLElement} root
 * @param {AbortSignal} signal
 */
export function keepKeys(root, signal) {
  root.setAttribute(MARK, "true");
  root.addEventListener(
    "focusin",
    ({ target }) => /** @type {Element} */ (target).setAttribute(MARK, "true"),
    { signal },
  );
  window.addEventListener(
    "keydown",
    (event) => {
      if (!isSaving(event) || !root.contains(/** @type {Node} */ (event.target))) return;
      const marked = [root, ...root.querySelectorAll(`[${MARK}]`)];
      for (const node of marked) node.removeAttribute(MARK);
      // JupyterLab looks as soon as the key is on its way.
      setTimeout(() => {
        for (const node of marked) node.setAttribute(MARK, "true");
      });
    },
    { signal, capture: true },
  );
}

/**
 * A control that is disabled while it has the focus drops it, and the keys that follow are lost:
 * the root takes it, and gives it back when the control is enabled again.
 *
 * @param {HTMLElement} root
 * @param {AbortSignal} signal
 */
export function keepFocus(root, signal) {
  root.tabIndex = -1;
  /** @type {HTMLElement | null} */
  let waiting = null;
  const seen = new MutationObserver((changes) => {
    for (const { target } of changes) {
      const node = /** @type {HTMLElement} */ (target);
      const { activeElement } = /** @type {Document | ShadowRoot} */ (root.getRootNode());
      if (node.matches(":disabled")) {
        if (activeElement !== node) continue;
        waiting = node;
        root.focus({ preventScroll: true });
      } else if (waiting === node) {
        if (activeElement === root) node.focus({ preventScroll: true });
        waiting = null;
      }
    }
  });
  seen.observe(root, { subtree: true, attributeFilter: ["disabled"] });
  signal.addEventListener("abort", () => seen.disconnect());
}

/** @param {KeyboardEvent} event */
function isSaving({ key, ctrlKey, metaKey, altKey, shiftKey }) {
  return (ctrlKey || metaKey) && !altKey && !shiftKey && key.toLowerCase() === "s";
}
