/**
 * The WebGL contexts of a page, least recently drawn first.
 *
 * A browser allows few (Chromium 16) and kills the oldest without asking, whoever owns it; each of
 * ours holds the pictures and maps of one view in graphics memory. So all surfaces of the page, of
 * every bundle and every copy of a bundle, register here, and the least recently drawn one releases
 * its context before another is made. It makes a new one when it is drawn again.
 */

const KEY = Symbol.for("sunwidget.contexts");

export const MOST_CONTEXTS = 4;

/**
 * Functions that release a context; a set keeps their order.
 *
 * @returns {Set<() => void>}
 */
function contexts() {
  const page = /** @type {Record<symbol, Set<() => void>>} */ (/** @type {unknown} */ (globalThis));
  page[KEY] ??= new Set();
  return page[KEY];
}

/**
 * Register a context before it is made or used.
 *
 * @param {() => void} release releases it; always the same function for one owner
 */
export function useContext(release) {
  const all = contexts();
  all.delete(release);
  all.add(release);
  for (const oldest of all) {
    if (all.size <= MOST_CONTEXTS) break;
    all.delete(oldest);
    oldest();
  }
}

/** Unregister a lost context. @param {() => void} release */
export function forgetContext(release) {
  contexts().delete(release);
}
