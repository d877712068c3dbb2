/**
 * One view of a study: the rater chooses between two pictures. The answers are in the model
 * (`_answers`), so that a reload continues where the rater was.
 */

import { button } from "../ui/button.js";
import { download } from "../ui/download.js";
import { element } from "../ui/element.js";
import { csv } from "./csv.js";
import { Pictures } from "./pictures.js";
import { endScreen, savedScreen, startScreen } from "./screens.js";
import { trials } from "./trials.js";

/**
 * @typedef {import("./csv.js").Answer} Answer
 * @typedef {import("./trials.js").Trial} Trial
 */

const PAUSE_MS = 250; // of plain gray, so that no pair is compared with the previous one
/** @type {Record<string, Answer["choice"]>} */
const KEYS = { ArrowLeft: "left", f: "left", ArrowRight: "right", j: "right" };

export class View {
  /**
   * @param {import("../host/types.js").Model} model
   * @param {HTMLElement} root
   * @param {AbortSignal} signal ends the view
   */
  constructor(model, root, signal) {
    this.model = model;
    this.root = root;
    this.asSaved = Boolean(model.get("_saved"));
    const pictures = this.asSaved ? [model.get("_thumbnail")] : model.get("_pictures");
    this.pictures = new Pictures(pictures, signal);
    this.ties = Boolean(model.get("_ties"));
    this.rater = String(model.get("rater"));
    this.running = false;
    /** @type {Trial | null} the pair on the screen */
    this.shown = null;
    this.since = 0; // when it appeared, ms
    this.loads = 0;
    this.saved = 0; // number of answers saved to a file

    this.progress = element("span", { class: "sw-study-progress", role: "status" });
    this.undo = button({
      icon: "undo",
      label: "Undo",
      title: "Undo the last answer (Backspace)",
      caption: true,
      onClick: () => this.undoAnswer(),
    });
    this.bar = element("div", { class: "sw-study-bar" });
    this.stage = element("div", { class: "sw-study-stage" });
    this.choices = element("div", { class: "sw-study-choices" });
    root.append(
      element(
        "div",
        { class: "sw-toolbar" },
        element("strong", { class: "sw-study-question" }, String(model.get("_question"))),
        element("div", { class: "sw-group sw-end" }, this.progress, this.undo),
      ),
      element("div", { class: "sw-study-track" }, this.bar),
      this.stage,
      this.choices,
    );
    root.addEventListener("keydown", (event) => this.onKey(event), { signal });
    const onAnswers = () => this.show();
    const onRater = () => {
      if (model.get("rater") === this.rater) return;
      this.rater = String(model.get("rater"));
      this.running = false;
      this.show();
    };
    // Without a kernel the answers are lost when the window closes.
    const onLeave = (/** @type {Event} */ event) => {
      if (model.get("_standalone") && this.answers().length > this.saved) event.preventDefault();
    };
    window.addEventListener("beforeunload", onLeave, { signal });
    model.on("change:_answers", onAnswers);
    model.on("change:rater", onRater);
    signal.addEventListener("abort", () => {
      model.off("change:_answers", onAnswers);
      model.off("change:rater", onRater);
      this.loads += 1;
    });
    this.show();
  }

  /** @returns {Answer[]} of all raters */
  answers() {
    return this.model.get("_answers") ?? [];
  }

  /** @returns {Answer[]} of this rater, in order */
  own() {
    return this.answers().filter(({ rater }) => rater === this.rater);
  }

  /** This rater's trials in order. */
  trials() {
    return trials(this.model.get("_groups"), {
      seed: this.model.get("_seed"),
      repeats: this.model.get("_repeats"),
      rater: this.rater,
    });
  }

  /** Update everything from the answers. */
  show() {
    if (this.asSaved) {
      void this.showSaved();
      return;
    }
    const all = this.trials();
    const { length: done } = this.own();
    const over = done >= all.length;
    const trial = this.running && !over ? all[done] : null;
    this.undo.hidden = !this.running || done === 0;
    this.progress.textContent = trial ? `${done + 1} of ${all.length}` : "";
    this.bar.style.transform = `scaleX(${done / all.length})`;
    this.root.classList.toggle("sw-study-asks", trial !== null);
    if (trial) void this.showTrial(trial, all[done + 1]);
    else {
      this.loads += 1;
      this.shown = null;
      this.choices.replaceChildren();
      this.stage.replaceChildren(
        this.running && over
          ? endScreen({
              all: all.length,
              onSave: () => this.save(),
              onNext: () => this.nextRater(),
            })
          : startScreen({
              rater: this.rater,
              done,
              all: all.length,
              ties: this.ties,
              onStart: (rater) => this.begin(rater),
            }),
      );
    }
  }

  /** Show a saved study, without the pictures of its pairs. */
  async showSaved() {
    this.undo.hidden = true;
    const screen = savedScreen(this.answers().length, () => this.save());
    this.stage.replaceChildren(screen);
    try {
      const image = await this.pictures.load(0);
      image.alt = "Two of the pictures";
      screen.prepend(image);
    } catch {
      // The text alone is enough.
    }
  }

  /**
   * @param {Trial} trial
   * @param {Trial | undefined} next decoded in advance
   */
  async showTrial(trial, next) {
    this.loads += 1;
    const load = this.loads;
    this.shown = null;
    this.choices.replaceChildren(...this.choiceButtons(true));
    this.stage.replaceChildren();
    const pause = new Promise((resolve) => setTimeout(resolve, PAUSE_MS));
    try {
      const images = await Promise.all(
        [trial.left, trial.right].map(({ picture }) => this.pictures.load(picture)),
      );
      await pause;
      if (load !== this.loads) return;
      this.stage.replaceChildren(
        ...images.map((image, i) => this.figure(image, i ? "right" : "left")),
      );
      this.choices.replaceChildren(...this.choiceButtons(false));
      this.shown = trial;
      this.since = performance.now();
      for (const { picture } of next ? [next.left, next.right] : []) {
        void this.pictures.load(picture).catch(() => {});
      }
    } catch {
      if (load !== this.loads) return;
      this.stage.replaceChildren(
        element("p", { class: "sw-study-text" }, "A picture of this pair cannot be decoded."),
      );
    }
    this.root.focus({ preventScroll: true });
  }

  /**
   * @param {HTMLImageElement} image
   * @param {"left" | "right"} side
   */
  figure(image, side) {
    image.alt = `The picture on the ${side}`;
    const node = element("div", { class: "sw-study-picture" }, image);
    node.addEventListener("click", () => this.answer(side));
    return node;
  }

  /** @param {boolean} disabled */
  choiceButtons(disabled) {
    /** @type {[Answer["choice"], string, string][]} */
    const rows = [
      ["left", "Left", "Choose the left picture (← or F)"],
      ["right", "Right", "Choose the right picture (→ or J)"],
    ];
    if (this.ties) rows.splice(1, 0, ["tie", "Cannot decide", "Neither is better (↓ or Space)"]);
    return rows.map(([choice, label, title]) => {
      const node = element("button", { type: "button", class: "sw-chip", title, disabled }, label);
      node.addEventListener("click", () => this.answer(choice));
      return node;
    });
  }

  /** @param {Answer["choice"]} choice */
  answer(choice) {
    const trial = this.shown;
    if (!trial) return;
    this.shown = null;
    const { length: done } = this.own();
    this.write([
      ...this.answers(),
      {
        rater: this.rater,
        trial: done + 1,
        picture: trial.group,
        left: trial.left.name,
        right: trial.right.name,
        choice,
        seconds: Math.round(performance.now() - this.since) / 1000,
        timestamp: new Date().toISOString(),
      },
    ]);
  }

  undoAnswer() {
    const last = this.own().at(-1);
    if (last) this.write(this.answers().filter((answer) => answer !== last));
  }

  /** @param {Answer[]} answers */
  write(answers) {
    // Calls back at once, which updates the view.
    this.model.set("_answers", answers);
    this.model.save_changes();
  }

  /** @param {KeyboardEvent} event */
  onKey(event) {
    if (!this.running || event.target instanceof HTMLInputElement) return;
    if (event.ctrlKey || event.metaKey || event.altKey || event.repeat) return;
    const onButton = event.target instanceof HTMLButtonElement;
    const tie = this.ties && (event.key === "ArrowDown" || (event.key === " " && !onButton));
    const choice = tie ? "tie" : KEYS[event.key];
    if (event.key === "Backspace") this.undoAnswer();
    else if (choice) this.answer(choice);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** @param {string} rater */
  begin(rater) {
    this.rater = rater;
    this.running = true;
    this.model.set("rater", rater);
    this.model.save_changes();
    this.show();
    this.root.focus({ preventScroll: true });
  }

  /** Hand over to another rater; existing answers are kept. */
  nextRater() {
    this.rater = "";
    this.running = false;
    this.model.set("rater", "");
    this.model.save_changes();
    this.show();
  }

  save() {
    const blob = new Blob([csv(this.answers())], { type: "text/csv" });
    const day = new Date().toISOString().slice(0, 10);
    download(blob, `study-${day}.csv`);
    this.saved = this.answers().length;
  }
}
