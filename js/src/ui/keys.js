/**
 * Keyboard shortcuts of a widget: matches key presses to a table's rows and formats key names.
 */

/**
 * One row of a shortcut table. A row without `run` documents keys that a focused part handles itself.
 *
 * @template V the view
 * @typedef {{
 *   keys: string[],
 *   label: string,
 *   section: string,
 *   run?: (view: V, event: KeyboardEvent) => unknown,
 * }} Shortcut `keys` are alternatives such as "B", "Mod+Z" (Ctrl, on a Mac ⌘), "Shift+M", "[",
 *   "Space" or "Escape"; `run` may return false to leave the key to later rows and to the host
 */

/**
 * Keys of widgets with a history.
 *
 * @type {Shortcut<{ state: import("../edit/state.js").EditState }>[]}
 */
export const HISTORY_KEYS = [
  { section: "History", keys: ["Mod+Z"], label: "Undo", run: (view) => view.state.undo() },
  {
    section: "History",
    keys: ["Mod+Shift+Z", "Mod+Y"],
    label: "Redo",
    run: (view) => view.state.redo(),
  },
];

/**
 * Keys of widgets with a zoomable picture.
 *
 * @template V
 * @param {string} section
 * @param {(view: V) => import("../geometry/zoom.js").Zoom} of
 * @returns {Shortcut<V>[]}
 */
export const zoomKeys = (section, of) => [
  { section, keys: ["+", "="], label: "Zoom in", run: (view) => of(view).step(1) },
  { section, keys: ["-"], label: "Zoom out", run: (view) => of(view).step(-1) },
  { section, keys: ["0", "Mod+0"], label: "Whole picture", run: (view) => of(view).fit() },
  { section, keys: ["Z"], label: "100 %, or whole picture", run: (view) => of(view).toggle() },
];

const MOVES = [
  ...["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"],
  ...["Home", "End", "PageUp", "PageDown"],
];
const PRESSES = ["Enter", "Space"];
const WRITES =
  'textarea, [contenteditable="true"], ' +
  'input:not([type="range"], [type="checkbox"], [type="radio"], [type="button"], [type="color"])';
const MOVED =
  'input[type="range"], input[type="radio"], [role="slider"], [role="radio"], ' +
  '[role="separator"], [role="application"], [role^="menuitem"], [role="option"]';
const PRESSED = 'button, summary, a, input, [role="button"], [role^="menuitem"], [role="option"]';

/**
 * Run the shortcut of a key press.
 *
 * @template V
 * @param {readonly Shortcut<V>[]} shortcuts
 * @param {V} view
 * @param {KeyboardEvent} event
 */
export function runShortcut(shortcuts, view, event) {
  if (event.defaultPrevented || event.isComposing || isTaken(event)) return;
  const meant = shortcuts.filter(({ run, keys }) => run && keys.some((key) => matches(key, event)));
  for (const { run } of meant) {
    if (run?.(view, event) === false) continue;
    event.preventDefault();
    event.stopPropagation();
    return;
  }
}

/** Whether the focused control needs the key itself. @param {KeyboardEvent} event */
export function isTaken(event) {
  const target = /** @type {Element} */ (event.target);
  if (target.matches(WRITES)) return true;
  if (event.ctrlKey || event.metaKey) return false;
  const key = nameOf(event);
  if (target.matches("select")) return key !== "Escape";
  return (
    (MOVES.includes(key) && target.matches(MOVED)) ||
    (PRESSES.includes(key) && target.matches(PRESSED))
  );
}

/** @param {KeyboardEvent} event */
const nameOf = (event) => (event.key === " " ? "Space" : event.key);

/** A shortcut's parts; the last is the key, which may be "+". @param {string} shortcut */
const split = (shortcut) => shortcut.split(/\+(?!$)/);

/**
 * @param {string} shortcut
 * @param {KeyboardEvent} event
 */
export function matches(shortcut, event) {
  const parts = split(shortcut);
  const key = parts[parts.length - 1];
  if (nameOf(event).toLowerCase() !== key.toLowerCase()) return false;
  // Symbols need Shift or AltGr on some keyboards and neither on others.
  const sign = key.length === 1 && !/[a-z0-9]/i.test(key);
  const composed = sign && event.getModifierState("AltGraph");
  const mod = (event.ctrlKey || event.metaKey) && !composed;
  if (mod !== parts.includes("Mod")) return false;
  return sign || (event.shiftKey === parts.includes("Shift") && !event.altKey);
}

/** @type {Record<string, string>} */
const NAMES = {
  Escape: "Esc",
  ArrowLeft: "←",
  ArrowRight: "→",
  ArrowUp: "↑",
  ArrowDown: "↓",
  "-": "−",
};

/**
 * Return a shortcut's keys as printed on the keyboard.
 *
 * @param {string} shortcut
 * @param {boolean} [apple] whether the keyboard is Apple's
 */
export function keyNames(shortcut, apple = /^(Mac|iP)/.test(navigator.platform)) {
  return split(shortcut).map((part) =>
    part === "Mod" ? (apple ? "⌘" : "Ctrl") : part in NAMES ? NAMES[part] : part,
  );
}
