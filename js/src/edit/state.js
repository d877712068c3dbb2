/**
 * The edit that this view shows, synchronized with the model's traits.
 *
 * The view draws from `values` at once; traits follow, throttled during a gesture and exact at its
 * end. The history is plain data on the model (`_history`), written by whoever made the step, so
 * undo works the same in the browser, in Python and in a second view.
 */

import { equal, sameRecipe } from "./equality.js";
import { newest } from "./history_limit.js";

/**
 * @typedef {import("../host/types.js").Edit} Edit
 * @typedef {import("../host/types.js").History} History
 * @typedef {import("../host/types.js").Model} Model
 * @typedef {import("../host/types.js").Parameter} Parameter
 * @typedef {import("../host/types.js").Version} Version
 * @typedef {import("../host/types.js").Kept} Kept
 */

const THROTTLE_MS = 100;
const HISTORY = ["_history", "_versions", "key_frames"];

export class EditState {
  /**
   * @param {Model} model
   * @param {Parameter[]} parameters
   * @param {AbortSignal} signal
   */
  constructor(model, parameters, signal) {
    this.model = model;
    this.parameters = parameters;
    /** @type {Set<() => void>} */
    this.listeners = new Set();
    /** @type {Edit} */
    this.values = {};
    for (const { name } of parameters) this.values[name] = model.get(name);
    /** @type {Edit | null} recipe at the start of the current gesture */
    this.before = null;
    /** @type {Set<string>} names not yet sent */
    this.unsent = new Set();
    /** @type {Set<string>} names that the current gesture has changed */
    this.held = new Set();
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
    /**
     * When the photo's maps can follow a correction. Corrections are refused unless "now"; with
     * "never", undo does not change them either.
     *
     * @type {() => "now" | "later" | "never"}
     */
    this.follow = () => "now";
    /** @type {() => void} called when a correction was sent */
    this.onCorrection = () => {};

    const onTrait = () => this.pull();
    for (const { name } of parameters) model.on(`change:${name}`, onTrait);
    const onHistory = () => this.notify();
    for (const name of HISTORY) model.on(`change:${name}`, onHistory);
    signal.addEventListener("abort", () => {
      this.commit(); // closing a view during a drag ends the drag
      clearTimeout(this.timer);
      for (const { name } of parameters) model.off(`change:${name}`, onTrait);
      for (const name of HISTORY) model.off(`change:${name}`, onHistory);
      this.listeners.clear();
    });
  }

  /** @param {() => void} listener called after every change */
  subscribe(listener) {
    this.listeners.add(listener);
  }

  notify() {
    for (const listener of this.listeners) listener();
  }

  /**
   * Take the model's values, except unsent changes and values that the current gesture has changed:
   * an older value that arrives late must not pull the sun away from the pointer.
   */
  pull() {
    let moved = false;
    for (const { name } of this.parameters) {
      if (this.unsent.has(name) || this.held.has(name)) continue;
      const value = this.model.get(name);
      if (equal(value, this.values[name])) continue;
      this.values[name] = value;
      moved = true;
    }
    if (moved) this.notify();
  }

  /**
   * Change values. Outside a gesture (`begin` … `commit`) this is one history step.
   *
   * @param {Edit} changes
   */
  set(changes) {
    const single = this.before === null;
    if (single) this.begin();
    for (const [name, value] of Object.entries(changes)) {
      if (equal(this.values[name], value)) continue;
      if (this.follow() !== "now" && this.isCorrection(name)) continue;
      this.values[name] = value;
      this.unsent.add(name);
      this.held.add(name);
    }
    this.notify();
    if (single) this.commit();
    else this.timer ??= setTimeout(() => this.push(), THROTTLE_MS);
  }

  /** @param {string} name */
  isCorrection(name) {
    return this.parameters.some((p) => p.name === name && p.analysis);
  }

  /** Start a gesture: all changes until `commit` are one history step. */
  begin() {
    this.before ??= this.recipe();
  }

  /** End the gesture and send its final values. */
  commit() {
    const before = this.before;
    this.before = null;
    for (const name of this.held) {
      if (!equal(this.model.get(name), this.values[name])) this.unsent.add(name);
    }
    this.held.clear();
    if (before && !equal(before, this.recipe())) {
      const { past } = this.history();
      this.writeHistory({ past: newest([...past, before]), future: [] });
    }
    this.push();
  }

  /** End the gesture and revert its changes. */
  cancel() {
    if (!this.before) return;
    const before = this.before;
    this.before = null;
    this.held.clear();
    this.apply(before);
  }

  /** Send unsent changes. */
  push() {
    clearTimeout(this.timer);
    this.timer = undefined;
    const names = [...this.unsent];
    // model.set calls back at once; `pull` skips names still listed as unsent.
    for (const name of names) this.model.set(name, this.values[name]);
    this.unsent.clear();
    this.model.save_changes();
    if (this.follow() === "now" && names.some((name) => this.isCorrection(name))) {
      this.onCorrection();
    }
  }

  /** Values that differ from their defaults, by name. */
  recipe() {
    /** @type {Edit} */
    const recipe = {};
    for (const p of this.parameters) {
      if (!equal(this.values[p.name], p.default)) recipe[p.name] = this.values[p.name];
    }
    return recipe;
  }

  /**
   * Apply a whole recipe; names that it lacks return to their defaults.
   *
   * @param {Edit} recipe
   */
  apply(recipe) {
    this.assign(recipe);
    this.push();
    this.notify();
  }

  /** Apply a recipe without sending it. @param {Edit} recipe */
  assign(recipe) {
    for (const p of this.parameters) {
      const value = p.name in recipe ? recipe[p.name] : p.default;
      if (equal(this.values[p.name], value)) continue;
      if (this.follow() === "never" && p.analysis) continue;
      this.values[p.name] = value;
      this.unsent.add(p.name);
    }
  }

  /** @returns {History} */
  history() {
    const { past = [], future = [] } = this.model.get("_history") ?? {};
    return { past, future };
  }

  /** @param {History} history */
  writeHistory(history) {
    this.model.set("_history", history);
  }

  undo() {
    if (this.before) {
      this.cancel();
      return;
    }
    const { past, future } = this.history();
    const recipe = past.at(-1);
    if (!recipe) return;
    this.writeHistory({ past: past.slice(0, -1), future: [this.recipe(), ...future] });
    this.apply(recipe);
  }

  redo() {
    const { past, future } = this.history();
    const recipe = future[0];
    if (!recipe || this.before) return;
    this.writeHistory({ past: [...past, this.recipe()], future: future.slice(1) });
    this.apply(recipe);
  }

  /** Reset every parameter to its default, as one history step. */
  reset() {
    this.replace({});
  }

  /** Apply a whole recipe as one history step. @param {Edit} recipe */
  replace(recipe) {
    this.commit();
    const before = this.recipe();
    this.assign(recipe);
    if (sameRecipe(before, this.recipe())) return;
    this.writeHistory({ past: newest([...this.history().past, before]), future: [] });
    this.push();
    this.notify();
  }

  /** @returns {Version[]} kept by name, oldest first */
  versions() {
    return this.model.get("_versions") ?? [];
  }

  /** @returns {import("../film/film_path.js").KeyFrame[]} of the film, sorted */
  keyFrames() {
    return this.model.get("key_frames") ?? [];
  }

  /** @param {Version[]} versions */
  writeVersions(versions) {
    this.model.set("_versions", versions);
    this.model.save_changes();
  }

  /** @param {import("../film/film_path.js").KeyFrame[]} frames sorted */
  writeKeyFrames(frames) {
    this.model.set("key_frames", frames);
    this.model.save_changes();
  }

  /** Return the state to keep, as if the current gesture ended now. @returns {Kept} */
  kept() {
    const { past, future } = this.history();
    const recipe = this.recipe();
    const moved = this.before && !sameRecipe(this.before, recipe);
    return {
      recipe,
      past: moved ? newest([...past, /** @type {Edit} */ (this.before)]) : past,
      future: moved ? [] : future,
      versions: this.versions(),
      keyFrames: this.keyFrames(),
    };
  }

  /** Restore the history of the same recipe. @param {Kept} kept */
  restoreHistory({ past, future }) {
    this.writeHistory({ past, future });
    this.model.save_changes();
  }

  /** Drop the gesture and unsent changes: the model now holds another photo's edit. */
  abandon() {
    clearTimeout(this.timer);
    this.timer = undefined;
    this.before = null;
    this.unsent.clear();
    this.held.clear();
    this.pull();
  }

  /**
   * Restore a stored state. The current edit becomes a history step.
   *
   * @param {Kept} kept
   */
  restore(kept) {
    this.commit();
    const now = this.kept();
    const fresh = now.past.length === 0 && Object.keys(now.recipe).length === 0;
    this.assign(kept.recipe);
    this.writeHistory(
      fresh
        ? { past: kept.past, future: kept.future }
        : { past: newest([...kept.past, ...now.past, now.recipe]), future: [] },
    );
    const names = new Set(now.versions.map(({ name }) => name));
    const others = kept.versions.filter(({ name }) => !names.has(name));
    this.model.set("_versions", [...now.versions, ...others]);
    if (!now.keyFrames.length) this.model.set("key_frames", kept.keyFrames);
    this.push();
    this.notify();
  }
}
