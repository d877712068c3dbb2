/**
 * Colours of the style sheet as a canvas needs them. Style sheets follow the host's theme by
 * themselves (`color-scheme` in style.css); what is drawn has to be drawn anew.
 */

/** @typedef {Record<string, string>} Theme */

/**
 * Read colours, and say whether any is another.
 *
 * @param {HTMLElement} root of the widget, in the page
 * @param {readonly string[]} names of custom properties without `--sw-`
 * @param {Theme} theme takes them, as `rgb(…)`
 */
export function readTheme(root, names, theme) {
  // A custom property reads as it was written; only a property that uses it has the colour.
  const probe = root.ownerDocument.createElement("span");
  probe.hidden = true;
  // Lines that differ by their colour alone keep it under the system's few.
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
 * @param {() => void} onChange the page's theme changed; the theme has the new colours
 * @param {AbortSignal} signal
 * @returns {Theme} empty before the widget is put into the page, as no style applies outside:
 *   whoever draws reads it first
 */
export function followTheme(root, names, onChange, signal) {
  /** @type {Theme} */
  const theme = {};
  const look = () => {
    if (readTheme(root, names, theme)) onChange();
  };
  const observer = new MutationObserver(look);
  for (const node of [document.documentElement, document.body]) {
    observer.observe(node, {
      attributes: true,
      attributeFilter: ["data-jp-theme-light", "data-theme", "theme", "class"],
    });
  }
  for (const query of ["(prefers-color-scheme: dark)", "(forced-colors: active)"]) {
    matchMedia(query).addEventListener("change", look, { signal });
  }
  signal.addEventListener("abort", () => observer.disconnect());
  return theme;
}
