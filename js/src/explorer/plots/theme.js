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
 * Read the colours anew, and say whether any is another.
 *
 * @param {HTMLElement} root
 * @param {Theme} theme
 */
export function readTheme(root, theme) {
  const style = getComputedStyle(root);
  let changed = false;
  for (const name of NAMES) {
    const color = style.getPropertyValue(`--sw-${name}`).trim();
    changed ||= color !== theme[name];
    theme[name] = color;
  }
  return changed;
}

/**
 * @param {HTMLElement} root
 * @param {() => void} onChange the page's theme changed; `theme` has the new colours
 * @param {AbortSignal} signal
 * @returns {Theme} empty before the widget is put into the page, as no style applies outside:
 *   whoever draws reads it first
 */
export function followTheme(root, onChange, signal) {
  /** @type {Theme} */
  const theme = {};
  const look = () => {
    if (readTheme(root, theme)) onChange();
  };
  const observer = new MutationObserver(look);
  for (const node of [document.documentElement, document.body]) {
    observer.observe(node, {
      attributes: true,
      attributeFilter: ["data-jp-theme-light", "data-theme", "theme", "class"],
    });
  }
  const media = matchMedia("(prefers-color-scheme: dark)");
  media.addEventListener("change", look, { signal });
  signal.addEventListener("abort", () => observer.disconnect());
  return theme;
}
