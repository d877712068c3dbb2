/**
 * The WebGL contexts of a page, least recently drawn first.
 *
 * A browser keeps few (Chromium 16) and kills the oldest without asking, whoever's it is; each of
 * ours holds the pictures and maps of one view in graphics memory. So all surfaces of the page, of
 * every bundle and of every copy of a bundle, register here, and the one that was drawn longest ago
 * gives its context back before another is made. It makes a new one when it is drawn again.
 */

const KEY = Symbol.for("sunwidget.contexts");

export const MOST_CONTEXTS = 4;

/**
 * Ways to give a context back; a set keeps the order in which they were added.
 *
 * @returns {Set<() => void>}
 */
function contexts() {
  const page = /** @type {Record<symbol, Set<() => void>>} */ (/** @type {unknown} */ (globalThis));
  page[KEY] ??= new Set();
  return page[KEY];
}

/**
 * A context is about to be made or drawn with.
 *
 * @param {() => void} release gives it back; always the same function for one owner
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

/** A context is gone. @param {() => void} release */
export function forgetContext(release) {
  contexts().delete(release);
}
