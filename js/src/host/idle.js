/** Work that may wait until the page has nothing else to do. */

const FALLBACK_MS = 60; // where a browser cannot say when it is idle
const LATEST_MS = 1500; // a slow machine that composes frame after frame may never be idle

/**
 * @param {() => void} work
 * @returns {() => void} forgets the work
 */
export function whenIdle(work) {
  if (typeof requestIdleCallback === "function") {
    const id = requestIdleCallback(work, { timeout: LATEST_MS });
    return () => cancelIdleCallback(id);
  }
  const timer = setTimeout(work, FALLBACK_MS);
  return () => clearTimeout(timer);
}
