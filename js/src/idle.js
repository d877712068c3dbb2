/** Work that may wait until the page has nothing else to do. */

const FALLBACK_MS = 60; // where a browser cannot say when it is idle

/**
 * @param {() => void} work
 * @returns {() => void} forgets the work
 */
export function whenIdle(work) {
  if (typeof requestIdleCallback === "function") {
    const id = requestIdleCallback(work);
    return () => cancelIdleCallback(id);
  }
  const timer = setTimeout(work, FALLBACK_MS);
  return () => clearTimeout(timer);
}
