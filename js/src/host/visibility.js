/** Watches whether a view is visible: a notebook that runs all its cells makes many at once. */

const MARGIN = "200px"; // within this distance of the window counts as visible

/**
 * @param {HTMLElement} node
 * @param {AbortSignal} signal
 * @param {(visible: boolean) => void} onChange first called once the page is laid out
 */
export function watchVisibility(node, signal, onChange) {
  const observer = new IntersectionObserver(
    (entries) => onChange(entries[entries.length - 1].isIntersecting),
    { rootMargin: MARGIN },
  );
  observer.observe(node);
  signal.addEventListener("abort", () => observer.disconnect());
}
