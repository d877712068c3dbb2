/**
 * Keeps keys pressed in a widget from the host: JupyterLab would insert cells. Only the key that
 * saves the notebook still reaches it. Also keeps the focus, and so the keys, inside the widget.
 */

const MARK = "data-lm-suppress-shortcuts";

/**
 * JupyterLab ignores marked elements and their content; but it checks the focused element before its
 * ancestors, and some of its shortcuts require only a focus within the notebook. So every focused
 * element is marked too.
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
      // JupyterLab checks while the event is dispatched.
      setTimeout(() => {
        for (const node of marked) node.setAttribute(MARK, "true");
      });
    },
    { signal, capture: true },
  );
}

/**
 * A focused control that is disabled drops the focus, and later keys are lost: the root takes the
 * focus, and returns it when the control is enabled again.
 *
 * @param {HTMLElement} root
 * @param {AbortSignal} signal
 */
export function keepFocus(root, signal) {
  root.tabIndex = -1;
  /** @type {HTMLElement | null} */
  let waiting = null;
  const observer = new MutationObserver((changes) => {
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
  observer.observe(root, { subtree: true, attributeFilter: ["disabled"] });
  signal.addEventListener("abort", () => observer.disconnect());
}

/** @param {KeyboardEvent} event */
function isSaving({ key, ctrlKey, metaKey, altKey, shiftKey }) {
  return (ctrlKey || metaKey) && !altKey && !shiftKey && key.toLowerCase() === "s";
}
