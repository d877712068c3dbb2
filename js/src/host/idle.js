/** Runs work when the page is idle. */

const FALLBACK_MS = 60; // for browsers without requestIdleCallback
const LATEST_MS = 1500; // a slow machine that draws frame after frame may never be idle

/**
 * @param {() => void} work
 * @returns {() => void} cancels the work
 */
export function whenIdle(work) {
  if (typeof requestIdleCallback === "function") {
    const id = requestIdleCallback(work, { timeout: LATEST_MS });
    return () => cancelIdleCallback(id);
  }
  const timer = setTimeout(work, FALLBACK_MS);
  return () => clearTimeout(timer);
}
