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
 * @param {HTMLElement} root
 * @param {() => void} onChange the page's theme changed; `theme` has the new colours
 * @param {AbortSignal} signal
 * @returns {Theme}
 */
export function followTheme(root, onChange, signal) {
  /** @type {Theme} */
  const theme = {};
  const read = () => {
    const style = getComputedStyle(root);
    for (const name of NAMES) theme[name] = style.getPropertyValue(`--sw-${name}`).trim();
  };
  const changed = () => {
    read();
    onChange();
  };
  read();
  const observer = new MutationObserver(changed);
  for (const node of [document.documentElement, document.body]) {
    observer.observe(node, {
      attributes: true,
      attributeFilter: ["data-jp-theme-light", "data-theme", "theme", "class"],
    });
  }
  const media = matchMedia("(prefers-color-scheme: dark)");
  media.addEventListener("change", changed, { signal });
  signal.addEventListener("abort", () => observer.disconnect());
  return theme;
}
