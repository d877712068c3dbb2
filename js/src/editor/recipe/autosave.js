/**
 * Keeps edits from being lost. The widget's state holds the edit, its history, versions and key
 * frames, so a reloaded page gets them from the kernel. In case the kernel is gone, the browser also
 * stores them under the photo's fingerprint and offers them when the photo is next shown. A recipe
 * set in code is never replaced without asking.
 */

import { sameRecipe } from "../../edit/equality.js";
import { KeptEdits } from "../../edit/kept_edits.js";
import { checkRecipe } from "../../edit/recipe/check.js";
import { stepName } from "../../edit/step_names.js";
import { savedText } from "../../host/saved_state.js";
import { onTraits } from "../../host/traits.js";

/**
 * @typedef {import("../../host/types.js").Edit} Edit
 * @typedef {import("../../host/types.js").Kept} Kept
 * @typedef {import("../../host/types.js").Source} Source
 * @typedef {import("../../edit/kept_edits.js").Entry} Entry
 */

const PAUSE_MS = 500;
const LEAVING_MS = 1500;
const SESSIONS = Symbol.for("sunwidget.sessions");

/**
 * Number of views of each session in this page that has a kernel, also by photo: their edits need
 * no restoring. Every widget runs its own copy of this module, so the table is on the window.
 *
 * @returns {Map<string, number>}
 */
function liveSessions() {
  const page = /** @type {any} */ (window);
  page[SESSIONS] ??= new Map();
  return page[SESSIONS];
}

/**
 * @type {import("../types.js").MakePart<"hand" | "kernel" | "model" | "notices" | "parts"
 *   | "picture" | "state" | "toolbar">}
 */
export function autosave({ hand, kernel, model, notices, parts, picture, state, toolbar }, signal) {
  const store = new KeptEdits();
  const alive = liveSessions();
  /** @type {Source | null} */
  let source = null;
  /** @type {Edit} the edit that this photo started with here */
  let start = {};
  let counted = false; // whether this view is counted in `alive`
  let restored = false; // this photo's edit; older ones are then offered only by the menu
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let timer;

  const save = () => {
    clearTimeout(timer);
    timer = undefined;
    if (!source) return;
    kernel.check();
    const kept = state.kept();
    const { session, fingerprint } = source;
    const hasMore = [kept.past, kept.versions, kept.keyFrames].some((some) => some.length > 0);
    const untouched = sameRecipe(kept.recipe, start) && !hasMore;
    if (!untouched) store.put(fingerprint, { ...kept, session, saved: Date.now() });
    // Another view of this editor may have restored it.
    if (notices.has("restore") && !findLost()) notices.hide("restore");
  };

  /** Find the newest edit of this photo that cannot be reached from here. @returns {Entry | undefined} */
  const findLost = () => {
    if (!source) return undefined;
    const { fingerprint, session } = source;
    const kept = state.kept();
    return store
      .of(fingerprint)
      .filter((entry) => entry.session !== session && !alive.has(entry.session))
      .map((entry) => dropInvalid(state.parameters, entry))
      .find((entry) => isLost(entry, kept));
  };

  const offer = () => {
    const entry = restored ? undefined : findLost();
    if (!entry || entry.dismissed) {
      notices.hide("restore");
      return;
    }
    const fromCode = Object.keys(start).length > 0;
    notices.show("restore", {
      text: `Your last edit of this photo (${describe(entry)}, ${formatAge(entry.saved)}) is kept.${
        fromCode ? " It differs from the recipe in your code." : ""
      }`,
      actions: [{ label: "Restore", run: restore }],
      onClose: () => source && store.dismiss(source.fingerprint),
    });
  };

  /** @param {Entry} entry */
  const describe = (entry) => {
    const { parameters } = state;
    const edit = lastOf(entry);
    if (!Object.keys(edit).length) return entry.keyFrames.length ? "key frames" : "versions";
    return stepName({}, edit, {
      parameters,
      versions: entry.versions,
      presets: picture.scene?.presets,
    });
  };

  const restore = () => {
    const entry = findLost();
    if (entry) state.restore(entry);
    restored = true;
    offer();
  };

  const leave = () => {
    if (!counted || !source) return;
    counted = false;
    count(source, -1);
  };

  /** @param {Source} of @param {number} views */
  const count = (of, views) => {
    for (const key of [of.session, liveKey(of)]) {
      const left = (alive.get(key) ?? 0) + views;
      if (left > 0) alive.set(key, left);
      else alive.delete(key);
    }
  };

  /** Start with the first photo or a new one. */
  const begin = () => {
    clearTimeout(timer);
    timer = undefined;
    leave();
    source = model.get("_source") ?? null;
    if (!source?.fingerprint) return;
    start = state.recipe();
    // A further view of a live editor: the first view offers the stored edit.
    restored = alive.has(liveKey(source));
    const { fingerprint, session } = source;
    const own = store.of(fingerprint).find((entry) => entry.session === session);
    const kept = state.kept();
    const first = !alive.has(session);
    if (kernel.answers) {
      count(source, 1);
      counted = true;
    }
    // Another live view of it writes this entry.
    if (!own || !first) offer();
    else if (isLost(own, kept)) store.setAside(fingerprint, session);
    else if (sameRecipe(own.recipe, kept.recipe) && own.past.length > kept.past.length) {
      // The page was closed before the end of a drag reached the kernel.
      state.restoreHistory(own);
    }
    offer();
  };

  const onSource = () => {
    state.abandon();
    hand.cancel();
    begin();
  };
  const onChange = () => {
    timer ??= setTimeout(save, PAUSE_MS);
  };
  state.subscribe(onChange);
  onTraits(model, ["_source"], onSource, signal);
  const onLeave = () => {
    state.commit();
    save();
  };
  window.addEventListener("pagehide", onLeave, { signal });
  document.addEventListener("visibilitychange", save, { signal });
  kernel.onChange(() => {
    if (!kernel.answers) leave();
    showKernel({ kernel, model, notices });
    parts.show();
  });
  signal.addEventListener("abort", () => {
    if (timer !== undefined) save();
    leave();
  });
  toolbar.menu.add({
    group: "photo",
    label: "Restore last edit",
    title: "The last edit of this photo that this browser kept",
    shown: () => findLost() !== undefined,
    run: restore,
  });
  begin();
  showKernel({ kernel, model, notices });
  // When a cell runs again, its last editor may close after this one has opened.
  const late = setTimeout(() => notices.has("restore") || offer(), LEAVING_MS);
  signal.addEventListener("abort", () => clearTimeout(late));
  return {};
}

/** The key in `liveSessions` of an editor with the photo that it shows. @param {Source} source */
const liveKey = ({ session, fingerprint }) => `${session} ${fingerprint}`;

/** @param {Pick<Parameters<typeof autosave>[0], "kernel" | "model" | "notices">} needs */
function showKernel({ kernel, model, notices }) {
  if (kernel.state === "live" && kernel.silent) {
    notices.show("kernel", {
      text:
        "The kernel is not responding. It is busy, or if it was restarted, run the cell again. " +
        "Your edit is kept.",
    });
    return;
  }
  if (kernel.state !== "lost") {
    notices.hide("kernel");
    return;
  }
  if (model.get("_saved")) {
    notices.show("kernel", { text: savedText(model, "editor") });
    return;
  }
  notices.show("kernel", {
    text:
      "The editor's kernel is gone. The preview stays live and your edit is kept; run the cell " +
      "again for strokes, maps and full-size exports.",
  });
}

/**
 * Whether part of an entry cannot be reached from here by undo or a version.
 *
 * @param {Kept} entry
 * @param {Kept} here
 */
function isLost(entry, here) {
  if (entry.keyFrames.length && !here.keyFrames.length) return true;
  const reachable = [
    here.recipe,
    ...here.past,
    ...here.future,
    ...here.versions.map(({ recipe }) => recipe),
  ];
  return [lastOf(entry), ...entry.versions.map(({ recipe }) => recipe)].some(
    (recipe) => !sameRecipe(recipe, {}) && !reachable.some((known) => sameRecipe(recipe, known)),
  );
}

/** The entry's edit, or the one before it was reset. @param {Kept} entry @returns {Edit} */
const lastOf = ({ recipe, past }) => (Object.keys(recipe).length ? recipe : (past.at(-1) ?? {}));

/**
 * Drop an entry's values that the table refuses: another version may have written it.
 *
 * @param {import("../../host/types.js").Parameter[]} parameters
 * @param {Entry} entry
 * @returns {Entry}
 */
function dropInvalid(parameters, entry) {
  /** @param {Edit} recipe */
  const values = (recipe) => checkRecipe(parameters, recipe).values;
  return {
    ...entry,
    recipe: values(entry.recipe),
    past: entry.past.map(values),
    future: entry.future.map(values),
    versions: entry.versions.map(({ name, recipe }) => ({ name, recipe: values(recipe) })),
    keyFrames: entry.keyFrames.map(({ seconds, recipe }) => ({ seconds, recipe: values(recipe) })),
  };
}

/** @param {number} time milliseconds since 1970 */
function formatAge(time) {
  const minutes = Math.round((Date.now() - time) / 60_000);
  const format = new Intl.RelativeTimeFormat("en", { numeric: "auto" });
  if (minutes < 1) return "a moment ago";
  if (minutes < 60) return format.format(-minutes, "minute");
  if (minutes < 48 * 60) return format.format(-Math.round(minutes / 60), "hour");
  return format.format(-Math.round(minutes / (24 * 60)), "day");
}
