/** The edit as a recipe that leaves the page and comes back. */

import { download } from "./download.js";

const VERSION = 1; // twin of RECIPE_VERSION in sunwidget/edit.py

/** @type {import("./parts.js").MakePart} */
export function recipe(view) {
  const { menu } = view.toolbar;
  const text = () => JSON.stringify({ version: VERSION, ...view.state.recipe() }, null, 2);
  menu.add({
    group: "recipe",
    label: "Save recipe",
    title: "Every number that was changed, as a small JSON file",
    run: () => download(new Blob([text()], { type: "application/json" }), "recipe.json"),
  });
  return {};
}
