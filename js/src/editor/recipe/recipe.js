/** Saves and loads the edit as a recipe, by file or clipboard. */

import { checkRecipe } from "../../edit/recipe/check.js";
import { readRecipe } from "../../edit/recipe/read.js";
import { toJson, toPython } from "../../edit/recipe/write.js";
import { errorText } from "../../host/error_text.js";
import { copyText, readClipboard } from "../../ui/clipboard.js";
import { download } from "../../ui/download.js";
import { pickFile } from "../../ui/pick_file.js";

/**
 * @typedef {import("../types.js").Needs<"channel" | "kernel" | "message" | "notices"
 *   | "state">} Taker
 */

const FILES = ".json,.py,.txt,application/json,text/plain";
const SECONDS = 6; // that a success notice stays
const NO_KERNEL =
  "Reading Python needs a kernel, and none is running here. Paste the recipe as JSON instead: from " +
  "“Copy recipe” in an editor's menu, or from edit.to_json() in Python.";

/**
 * @type {import("../types.js").MakePart<"channel" | "kernel" | "message" | "model" | "notices"
 *   | "root" | "state" | "toolbar">}
 */
export function recipe({ model, root, toolbar, ...taker }, signal) {
  const { menu } = toolbar;
  const { message, state } = taker;
  /** @type {(text: string, what: string) => Promise<void>} */
  const copy = async (text, what) => {
    if (await copyText(text)) say(taker, `${what} copied.`);
    else message.show(`The page cannot use the clipboard. ${what}:\n${text}`);
  };
  menu.add({
    group: "recipe",
    label: "Save recipe",
    title: "Every value that was changed, as a small JSON file",
    run: () =>
      download(new Blob([toJson(state.recipe())], { type: "application/json" }), fileName(model)),
  });
  menu.add({
    group: "recipe",
    label: "Load recipe …",
    title: "Apply a recipe file, as one undo step",
    run: async () => {
      const file = await pickFile(FILES, signal);
      if (file) await loadRecipe(taker, file);
    },
  });
  menu.add({
    group: "recipe",
    label: "Copy recipe",
    title: "As JSON, to paste into another editor",
    run: () => copy(toJson(state.recipe()), "Recipe"),
  });
  menu.add({
    group: "recipe",
    label: "Copy as Python",
    title: "As code for a cell or a script",
    run: () => copy(toPython(state.recipe()), "Python"),
  });
  menu.add({
    group: "recipe",
    label: "Paste recipe",
    title: "JSON or Python copied from an editor; it is parsed, never run",
    run: async () => {
      const text = await readClipboard();
      if (text !== null) await useRecipe(taker, text);
      else say(taker, "The page cannot read the clipboard by itself: press Ctrl+V.");
    },
  });
  root.addEventListener(
    "paste",
    (event) => {
      const text = event.clipboardData?.getData("text/plain");
      if (!text || takesText(event.target)) return;
      event.preventDefault();
      useRecipe(taker, text);
    },
    { signal },
  );
  return {};
}

/** @param {EventTarget | null} target */
const takesText = (target) =>
  target instanceof HTMLTextAreaElement ||
  (target instanceof HTMLInputElement && target.type !== "range");

/** @param {Taker} taker @param {File} file */
export async function loadRecipe(taker, file) {
  await useRecipe(taker, await file.text());
}

/**
 * Apply a recipe from text as one history step, or say what is wrong with it.
 *
 * @param {Taker} taker
 * @param {string} text
 */
export async function useRecipe(taker, text) {
  const { message, notices, state } = taker;
  try {
    const recipe = await readRecipe(text, (python) => readPython(taker, python));
    const { values, problems } = checkRecipe(state.parameters, recipe);
    if (problems.length) throw new Error(problems.slice(0, 3).join(" "));
    const before = state.history().past.length;
    state.replace(values);
    message.show("");
    const moved = state.history().past.length !== before;
    say(taker, moved ? "Recipe applied." : "This recipe is already applied.", moved);
  } catch (error) {
    notices.hide("recipe"); // it is about another recipe
    message.show(`Nothing was changed. ${errorText(error)}`);
  }
}

/** @param {Taker} taker @param {string} text */
async function readPython({ channel, kernel, notices }, text) {
  if (!kernel.answers) throw new Error(NO_KERNEL);
  notices.show("recipe", { text: "The kernel is reading the Python …" }); // after its current cell
  return (await channel.request("recipe", { text })).result;
}

/** @param {Taker} taker @param {string} text @param {boolean} [undo] whether to offer to revert it */
function say({ notices, state }, text, undo = false) {
  notices.show("recipe", {
    text,
    actions: undo ? [{ label: "Revert", run: () => state.undo() }] : [],
    seconds: SECONDS,
  });
}

/** @param {import("../../host/types.js").Model} model */
function fileName(model) {
  const name = String(model.get("_source")?.name ?? "").replace(/\.[^.]*$/, "");
  return `${name || "picture"}-recipe.json`;
}
