/** Colours that a canvas needs as text, read from the style sheet and kept with the theme. */

const NAMES = [
  "text",
  "quiet",
  "line",
  "panel",
  "accent",
  "rayleigh",
  "aerosol",
  "ozone",
  "nm640",
  "nm580",
  "nm510",
  "nm440",
];

/** @typedef {Record<string, string>} Theme */

/**
 * Read the colours anew; before the widget stands on the page there are none.
 *
 * @param {HTMLElement} root
 * @param {Theme} theme
 */
export function readTheme(root, theme) {
  const style = getComputedStyle(root);
  for (const name of NAMES) theme[name] = style.getPropertyValue(`--sw-${name}`).trim();
}

/**
 * @param {HTMLElement} root
 * @param {() => void} onChange the page's theme changed; `theme` has the new colours
 * @param {AbortSignal} signal
 * @returns {Theme}
 */
export function followTheme(root, onChange, signal) {
  /** @type {Theme} */
  const theme = {};
  const changed = () => {
    readTheme(root, theme);
    onChange();
  };
  // JupyterLab renders a widget before it puts it into the page, and outside no style applies.
  const attached = new ResizeObserver(() => {
    if (!root.isConnected) return;
    attached.disconnect();
    changed();
  });
  if (!root.isConnected) attached.observe(root);
  const observer = new MutationObserver(changed);
  for (const node of [document.documentElement, document.body]) {
    observer.observe(node, {
      attributes: true,
      attributeFilter: ["data-jp-theme-light", "data-theme", "theme", "class"],
    });
  }
  const media = matchMedia("(prefers-color-scheme: dark)");
  media.addEventListener("change", changed, { signal });
  signal.addEventListener("abort", () => {
    observer.disconnect();
    attached.disconnect();
  });
  return theme;
}
