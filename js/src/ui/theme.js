/**
 * Reads the style sheet's colors for canvases. Style sheets follow the host's theme themselves
 * (`color-scheme` in style.css); canvases must be redrawn.
 */

/** @typedef {Record<string, string>} Theme */

/**
 * Read the colors; returns whether any changed.
 *
 * @param {HTMLElement} root of the widget, in the page
 * @param {readonly string[]} names of custom properties without `--sw-`
 * @param {Theme} theme receives them as `rgb(…)`
 */
export function readTheme(root, names, theme) {
  // A custom property reads back as written; only a property that uses it resolves the color.
  const probe = root.ownerDocument.createElement("span");
  probe.hidden = true;
  // Lines that differ only by color keep it in forced-colors mode.
  probe.style.setProperty("forced-color-adjust", "none");
  root.append(probe);
  const style = getComputedStyle(probe);
  let changed = false;
  for (const name of names) {
    probe.style.color = `var(--sw-${name})`;
    const { color } = style;
    changed ||= color !== theme[name];
    theme[name] = color;
  }
  probe.remove();
  return changed;
}

/**
 * @param {HTMLElement} root
 * @param {readonly string[]} names
 * @param {() => void} onChange called after a theme change, with the new colors in the theme
 * @param {AbortSignal} signal
 * @returns {Theme} empty until the widget is in the page, as no style applies outside it:
 *   read it before drawing
 */
export function followTheme(root, names, onChange, signal) {
  /** @type {Theme} */
  const theme = {};
  const update = () => {
    if (readTheme(root, names, theme)) onChange();
  };
  const observer = new MutationObserver(update);
  for (const node of [document.documentElement, document.body]) {
    observer.observe(node, {
      attributes: true,
      attributeFilter: ["data-jp-theme-light", "data-theme", "theme", "class"],
    });
  }
  for (const query of ["(prefers-color-scheme: dark)", "(forced-colors: active)"]) {
    matchMedia(query).addEventListener("change", update, { signal });
  }
  signal.addEventListener("abort", () => observer.disconnect());
  return theme;
}
