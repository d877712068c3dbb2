/** The screens before the first pair and after the last one. */

import { element } from "../ui/element.js";

/** @param {number} count */
const pairs = (count) => (count === 1 ? "one pair" : `${count} pairs`);

/**
 * The start screen: instructions and the rater's name.
 *
 * @param {{ rater: string, done: number, all: number, ties: boolean,
 *   onStart: (rater: string) => void }} options
 */
export function startScreen({ rater, done, all, ties, onStart }) {
  const name = element("input", {
    type: "text",
    class: "sw-study-rater",
    value: rater,
    maxlength: 80,
    placeholder: "Name or number",
    "aria-label": "Your name or number",
  });
  const begin = element(
    "button",
    { type: "submit", class: "sw-chip sw-primary" },
    done ? "Continue" : "Start",
  );
  const form = element("form", { class: "sw-study-form" }, name, begin);
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    onStart(name.value.trim());
  });
  const keys = ties ? " Press the down arrow if you cannot decide." : "";
  return element(
    "div",
    { class: "sw-study-text" },
    element(
      "p",
      {},
      `You will see ${pairs(all)} of pictures. Click the one you choose, or press the left or ` +
        `right arrow key.${keys} Backspace undoes the last answer. There is no wrong answer.`,
    ),
    ...(done ? [element("p", {}, `${done} of ${all} answered.`)] : []),
    form,
  );
}

/** @param {{ all: number, onSave: () => void, onNext: () => void }} options */
export function endScreen({ all, onSave, onNext }) {
  const next = element(
    "button",
    {
      type: "button",
      class: "sw-chip",
      title: "Hand over to another rater; the answers so far are kept",
    },
    "Next rater",
  );
  next.addEventListener("click", onNext);
  return element(
    "div",
    { class: "sw-study-text" },
    element("p", {}, `Thank you. You have answered ${all === 1 ? "" : "all "}${pairs(all)}.`),
    element("div", { class: "sw-study-form" }, saveButton(onSave), next),
  );
}

/**
 * The screen of a study opened from a saved notebook.
 *
 * @param {number} answers of all raters
 * @param {() => void} onSave
 */
export function savedScreen(answers, onSave) {
  return element(
    "div",
    { class: "sw-study-text" },
    element(
      "p",
      {},
      "A saved notebook keeps the answers of a study, not its pictures. " +
        (answers
          ? "Save them before you run the cell, which starts over."
          : "Run the cell to start."),
    ),
    ...(answers ? [element("div", { class: "sw-study-form" }, saveButton(onSave))] : []),
  );
}

/** @param {() => void} onSave */
function saveButton(onSave) {
  const node = element(
    "button",
    {
      type: "button",
      class: "sw-chip sw-primary",
      title: "Download all answers of this study as a CSV file",
    },
    "Save answers",
  );
  node.addEventListener("click", onSave);
  return node;
}
