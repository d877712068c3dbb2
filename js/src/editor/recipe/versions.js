/** Edits kept by name: a list under a button to keep, rename, apply and delete them. */

import { sameRecipe } from "../../edit/equality.js";
import { button } from "../../ui/button.js";
import { element } from "../../ui/element.js";
import { popup } from "../../ui/popup.js";

/** @typedef {import("../../edit/state.js").EditState} EditState */

// The same limits as in sunwidget/widgets/editor/history.py.
const MOST = 100;
const NAME_LENGTH = 80;

/** @type {import("../types.js").MakePart<"notices" | "state" | "toolbar">} */
export function versions({ notices, state, toolbar }) {
  const trigger = button({
    icon: "versions",
    label: "Versions",
    title: "Versions: edits kept by name (V)",
  });
  toolbar.versions = trigger;
  const name = element("input", {
    type: "text",
    class: "sw-versions-name",
    maxlength: NAME_LENGTH,
    "aria-label": "Name of the version",
  });
  const keep = element("button", { type: "submit", class: "sw-chip sw-primary" }, "Keep");
  const problem = element("p", { class: "sw-versions-problem", role: "alert", hidden: true });
  const form = element("form", { class: "sw-versions-form" }, name, keep);
  const list = element("ul", { class: "sw-versions-list" });
  const empty = element(
    "p",
    { class: "sw-versions-empty" },
    "Keep the current edit, and come back to it at any time.",
  );
  /** @param {string} text */
  const say = (text) => {
    problem.hidden = !text;
    problem.textContent = text;
  };
  const box = popup({
    anchor: trigger,
    attributes: { role: "dialog", "aria-label": "Versions", class: "sw-versions" },
    onOpen: () => {
      say("");
      name.value = freeName(state);
      show();
    },
    onOpened: () => name.select(),
  });
  box.node.append(form, problem, empty, list);
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const wrong = keepVersion(state, name.value);
    say(wrong);
    if (!wrong) name.value = freeName(state);
    name.select();
  });

  /** @param {import("../../host/types.js").Version} version */
  const row = (version) => {
    const go = element("button", { type: "button", class: "sw-versions-go" }, version.name);
    const here = sameRecipe(version.recipe, state.recipe());
    go.setAttribute("aria-current", String(here));
    go.title = here ? "This is the current edit" : `Go to “${version.name}”, as one undo step`;
    go.addEventListener("click", () => state.replace(version.recipe));
    const node = element(
      "li",
      {},
      go,
      button({ icon: "rename", label: `Rename “${version.name}”`, onClick: () => rename() }),
      button({
        icon: "close",
        label: `Delete “${version.name}”`,
        onClick: () => {
          const before = state.versions();
          state.writeVersions(before.filter((other) => other !== version));
          name.focus();
          notices.show("version", {
            text: `“${version.name}” was deleted.`,
            actions: [{ label: "Keep it", run: () => bringBack(state, version, before) }],
            seconds: 20,
          });
        },
      }),
    );
    const rename = () => {
      const field = element("input", {
        type: "text",
        class: "sw-versions-name",
        maxlength: NAME_LENGTH,
        "aria-label": `New name of “${version.name}”`,
      });
      field.value = version.name;
      let done = false;
      const finish = () => {
        if (done) return;
        done = true; // before the redraw, which takes the focus from the field
        say(renameVersion(state, version, field.value));
        show();
      };
      field.addEventListener("keydown", (event) => {
        if (event.key !== "Escape" && event.key !== "Enter") return;
        event.preventDefault(); // do not close the list or keep another version
        if (event.key === "Escape") field.value = version.name;
        finish();
        name.focus();
      });
      field.addEventListener("blur", finish);
      go.replaceWith(field);
      field.select();
    };
    return node;
  };

  let drawn = "";
  const show = () => {
    const kept = state.versions();
    list.replaceChildren(...kept.map(row).reverse());
    empty.hidden = kept.length > 0;
    trigger.title = kept.length
      ? `Versions: ${kept.length} ${kept.length === 1 ? "edit" : "edits"} kept by name (V)`
      : "Versions: keep this edit by name (V)";
  };
  toolbar.history.append(element("div", { class: "sw-menu-anchor" }, trigger, box.node));
  show();
  return {
    show() {
      // Redraw only if the list changes: a drag calls this many times a second.
      if (!box.isOpen || box.node.querySelector("li input")) return;
      const text = JSON.stringify([state.versions(), state.recipe()]);
      if (text !== drawn) show();
      drawn = text;
    },
  };
}

/** @param {EditState} state */
function freeName(state) {
  const names = new Set(state.versions().map((version) => version.name));
  let number = names.size + 1;
  while (names.has(`Version ${number}`)) number += 1;
  return `Version ${number}`;
}

/** Return what is wrong with a name, or "". @param {EditState} state @param {string} name */
function checkName(state, name) {
  if (!name) return "A version needs a name.";
  if (name.length > NAME_LENGTH) return `A name can have at most ${NAME_LENGTH} characters.`;
  const taken = state.versions().some((version) => version.name === name);
  return taken ? `“${name}” already exists. Choose another name.` : "";
}

/**
 * Keep the current edit; returns why that failed, or "".
 *
 * @param {EditState} state
 * @param {string} text
 */
function keepVersion(state, text) {
  const name = text.trim();
  const kept = state.versions();
  const wrong = checkName(state, name);
  if (wrong) return wrong;
  if (kept.length >= MOST) return `There are already ${MOST} versions. Delete one first.`;
  state.writeVersions([...kept, { name, recipe: state.recipe() }]);
  return "";
}

/** @type {(state: EditState, version: import("../../host/types.js").Version, text: string) => string} */
function renameVersion(state, version, text) {
  const name = text.trim();
  if (name === version.name) return "";
  const wrong = checkName(state, name);
  if (wrong) return wrong;
  state.writeVersions(
    state.versions().map((other) => (other.name === version.name ? { ...other, name } : other)),
  );
  return "";
}

/**
 * Put a deleted version back where it was, unless its name is taken again.
 *
 * @param {EditState} state
 * @param {import("../../host/types.js").Version} version
 * @param {import("../../host/types.js").Version[]} before the list before the deletion
 */
function bringBack(state, version, before) {
  const kept = state.versions();
  if (checkName(state, version.name)) return;
  const at = Math.min(before.indexOf(version), kept.length);
  state.writeVersions([...kept.slice(0, at), version, ...kept.slice(at)]);
}
