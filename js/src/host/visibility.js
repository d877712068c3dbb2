/** Whether a view is in sight: a notebook that runs all its cells makes many at once. */

const MARGIN = "200px"; // this near to the window counts as in sight

/**
 * @param {HTMLElement} node
 * @param {AbortSignal} signal
 * @param {(inSight: boolean) => void} onChange called first when the browser has laid the page out
 */
export function watchSight(node, signal, onChange) {
  const observer = new IntersectionObserver(
    (entries) => onChange(entries[entries.length - 1].isIntersecting),
    { rootMargin: MARGIN },
  );
  observer.observe(node);
  signal.addEventListener("abort", () => observer.disconnect());
}
