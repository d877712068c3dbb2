/**
 * Nothing that was done is lost. The widget's state holds the edit, its history, versions and key
 * frames, so a page that is loaded again has them from the kernel; for when that is gone the browser
 * keeps them too, by the photo's fingerprint, and offers them the next time the photo is shown.
 * A recipe that is given in code is never replaced unasked.
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
 * Sessions in this page that have a kernel, with how many views each has, also by photo: what
 * they do needs no restoring. Every widget runs a copy of this module of its own, so they meet at the window.
 *
 * @returns {Map<string, number>}
 */
function living() {
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
  const alive = living();
  /** @type {Source | null} */
  let source = null;
  /** @type {Edit} what this photo began with here */
  let start = {};
  let counted = false; // among the living
  let restored = false; // this photo's edit: still older ones are offered by the menu alone
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let timer;

  const save = () => {
    clearTimeout(timer);
    timer = undefined;
    if (!source) return;
    kernel.check();
    const kept = state.kept();
    const { session, fingerprint } = source;
    const made = [kept.past, kept.versions, kept.keyFrames].some((some) => some.length > 0);
    const untouched = sameRecipe(kept.recipe, start) && !made;
    if (!untouched) store.put(fingerprint, { ...kept, session, saved: Date.now() });
    // Another view of this editor may have restored it.
    if (notices.has("restore") && !lost()) notices.hide("restore");
  };

  /** The newest edit of this photo that cannot be reached from here. @returns {Entry | undefined} */
  const lost = () => {
    if (!source) return undefined;
    const { fingerprint, session } = source;
    const kept = state.kept();
    return store
      .of(fingerprint)
      .filter((entry) => entry.session !== session && !alive.has(entry.session))
      .map((entry) => readable(state.parameters, entry))
      .find((entry) => isLost(entry, kept));
  };

  const offer = () => {
    const entry = restored ? undefined : lost();
    if (!entry || entry.dismissed) {
      notices.hide("restore");
      return;
    }
    const given = Object.keys(start).length > 0;
    notices.show("restore", {
      text: `Your last edit of this photo (${called(entry)}, ${ago(entry.saved)}) is kept.${
        given ? " It differs from the recipe in your code." : ""
      }`,
      actions: [{ label: "Restore", run: restore }],
      onClose: () => source && store.dismiss(source.fingerprint),
    });
  };

  /** @param {Entry} entry */
  const called = (entry) => {
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
    const entry = lost();
    if (entry) state.takeUp(entry);
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
    for (const key of [of.session, atWork(of)]) {
      const left = (alive.get(key) ?? 0) + views;
      if (left > 0) alive.set(key, left);
      else alive.delete(key);
    }
  };

  /** With another photo, or the first one. */
  const begin = () => {
    clearTimeout(timer);
    timer = undefined;
    leave();
    source = model.get("_source") ?? null;
    if (!source?.fingerprint) return;
    start = state.recipe();
    // A further view of an editor at work: what was kept is the first one's to offer.
    restored = alive.has(atWork(source));
    const { fingerprint, session } = source;
    const own = store.of(fingerprint).find((entry) => entry.session === session);
    const kept = state.kept();
    const first = !alive.has(session);
    if (kernel.answers) {
      count(source, 1);
      counted = true;
    }
    // Another view of it, which is at work, writes this entry.
    if (!own || !first) offer();
    else if (isLost(own, kept)) store.setAside(fingerprint, session);
    else if (sameRecipe(own.recipe, kept.recipe) && own.past.length > kept.past.length) {
      // The page was left before the end of a drag had arrived at the kernel.
      state.takeUpHistory(own);
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
    shown: () => lost() !== undefined,
    run: restore,
  });
  begin();
  showKernel({ kernel, model, notices });
  // When a cell runs again, its last editor may go after this one has come.
  const late = setTimeout(() => notices.has("restore") || offer(), LEAVING_MS);
  signal.addEventListener("abort", () => clearTimeout(late));
  return {};
}

/** Among the living: an editor with the photo that it shows. @param {Source} source */
const atWork = ({ session, fingerprint }) => `${session} ${fingerprint}`;

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
 * Whether something of an entry cannot be reached from what is there by undo or by a version.
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

/** Its edit, or what it was before it was reset. @param {Kept} entry @returns {Edit} */
const lastOf = ({ recipe, past }) => (Object.keys(recipe).length ? recipe : (past.at(-1) ?? {}));

/**
 * An entry without values that the table does not take: another version may have written it.
 *
 * @param {import("../../host/types.js").Parameter[]} parameters
 * @param {Entry} entry
 * @returns {Entry}
 */
function readable(parameters, entry) {
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
function ago(time) {
  const minutes = Math.round((Date.now() - time) / 60_000);
  const format = new Intl.RelativeTimeFormat("en", { numeric: "auto" });
  if (minutes < 1) return "a moment ago";
  if (minutes < 60) return format.format(-minutes, "minute");
  if (minutes < 48 * 60) return format.format(-Math.round(minutes / 60), "hour");
  return format.format(-Math.round(minutes / (24 * 60)), "day");
}
