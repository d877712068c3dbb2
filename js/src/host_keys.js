/** Keys that are pressed in a widget are the widget's: JupyterLab would insert cells at them. */

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
}
