/**
 * Edits in the browser's storage, by the photo's fingerprint, so that they survive the kernel. The
 * storage may be missing, full, or written by another version; then less is kept, and nothing fails.
 */

/**
 * @typedef {import("../host/types.js").Kept} Kept
 * @typedef {Kept & { session: string, saved: number, dismissed?: boolean }} Entry `saved` in
 *   milliseconds since 1970; `dismissed` once the user declined it
 */

const PREFIX = "sunwidget:edits:";
const PHOTOS = 20;
const SESSIONS = 4; // per photo; each run of the cell is a session
const BYTES = 600_000; // per photo; a browser grants about 5 MB to all pages of a server

export class KeptEdits {
  /** @param {() => Storage} open may throw, as `localStorage` does where it is forbidden */
  constructor(open = () => window.localStorage) {
    this.open = open;
  }

  /**
   * Return a photo's entries, newest first.
   *
   * @param {string} fingerprint
   * @returns {Entry[]}
   */
  of(fingerprint) {
    try {
      const entries = JSON.parse(this.open().getItem(PREFIX + fingerprint) ?? "[]");
      return Array.isArray(entries) ? entries.filter(isEntry).map(whole) : [];
    } catch {
      return [];
    }
  }

  /**
   * Store an entry in place of its session's last one.
   *
   * @param {string} fingerprint
   * @param {Entry} entry
   */
  put(fingerprint, entry) {
    const others = this.of(fingerprint).filter(({ session }) => session !== entry.session);
    this.write(fingerprint, [entry, ...others]);
  }

  /** Mark a photo's entries as declined. @param {string} fingerprint */
  dismiss(fingerprint) {
    this.write(
      fingerprint,
      this.of(fingerprint).map((entry) => ({ ...entry, dismissed: true })),
    );
  }

  /**
   * Give an entry a new session name, so that its session does not overwrite it.
   *
   * @param {string} fingerprint
   * @param {string} session
   */
  setAside(fingerprint, session) {
    this.write(
      fingerprint,
      this.of(fingerprint).map((entry) =>
        entry.session === session ? { ...entry, session: `${session}~${entry.saved}` } : entry,
      ),
    );
  }

  /** @param {string} fingerprint @param {Entry[]} entries newest first */
  write(fingerprint, entries) {
    const key = PREFIX + fingerprint;
    try {
      const storage = this.open();
      this.makeRoom(storage, key);
      let kept = entries.slice(0, SESSIONS);
      while (!this.store(storage, key, kept)) {
        if (isHeavy(kept)) kept = shrink(kept);
        // Full: other photos' entries are older than this one.
        else if (!this.dropOldest(storage, key)) return;
      }
    } catch {
      // No storage: the widget's state still has everything.
    }
  }

  /** @param {Storage} storage @param {string} key @param {Entry[]} entries */
  store(storage, key, entries) {
    const text = JSON.stringify(entries);
    if (text.length > BYTES && isHeavy(entries)) return false;
    try {
      storage.setItem(key, text);
      return true;
    } catch {
      return false;
    }
  }

  /** @param {Storage} storage @param {string} key */
  makeRoom(storage, key) {
    if (storage.getItem(key) !== null) return;
    while (keys(storage).length >= PHOTOS) if (!this.dropOldest(storage, key)) return;
  }

  /** @param {Storage} storage @param {string} except @returns {boolean} whether one was dropped */
  dropOldest(storage, except) {
    const others = keys(storage).filter((key) => key !== except);
    const ages = others.map((key) => {
      const [newest] = this.of(key.slice(PREFIX.length));
      return { key, saved: newest?.saved ?? 0 };
    });
    const [oldest] = ages.sort((a, b) => a.saved - b.saved);
    if (oldest) storage.removeItem(oldest.key);
    return oldest !== undefined;
  }
}

/** @param {Storage} storage */
const keys = (storage) =>
  Array.from({ length: storage.length }, (_, i) => storage.key(i) ?? "").filter((key) =>
    key.startsWith(PREFIX),
  );

/** @param {Entry[]} entries */
const isHeavy = (entries) => entries.length > 1 || entries[0].past.length > 0;

/** Drop half of the past, or without one the oldest session. @param {Entry[]} entries */
function shrink(entries) {
  const steps = Math.max(...entries.map(({ past }) => past.length));
  if (steps === 0) return entries.slice(0, -1);
  return entries.map((entry) => ({
    ...entry,
    past: entry.past.slice(Math.ceil(entry.past.length / 2)),
    future: [],
  }));
}

/** @param {any} entry */
const isEntry = (entry) => isRecipe(entry?.recipe) && typeof entry.session === "string";

/** @param {any} value */
const isRecipe = (value) => typeof value === "object" && value !== null && !Array.isArray(value);

/** @param {any} entry @returns {Entry} */
const whole = ({ past, future, versions, keyFrames, saved, ...entry }) => ({
  ...entry,
  saved: Number(saved) || 0,
  past: Array.isArray(past) ? past.filter(isRecipe) : [],
  future: Array.isArray(future) ? future.filter(isRecipe) : [],
  versions: Array.isArray(versions)
    ? versions.filter((v) => typeof v?.name === "string" && isRecipe(v.recipe))
    : [],
  keyFrames: Array.isArray(keyFrames)
    ? keyFrames.filter((frame) => Number.isFinite(frame?.seconds) && isRecipe(frame.recipe))
    : [],
});
