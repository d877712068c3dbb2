/** What the analysis warns about: each note can be put away, and brought back. */

import { button } from "../controls/button.js";
import { element } from "../controls/element.js";

export class Notes {
  constructor() {
    this.list = element("div", { class: "sw-notes-list" });
    this.back = element("button", { type: "button", class: "sw-notes-back", hidden: true });
    this.back.addEventListener("click", () => {
      this.away.clear();
      this.draw();
    });
    this.node = element("div", { class: "sw-notes" }, this.list, this.back);
    /** @type {string[]} */
    this.texts = [];
    /** @type {Set<string>} */
    this.away = new Set();
  }

  /** @param {string[]} texts */
  show(texts) {
    this.texts = texts;
    this.draw();
  }

  draw() {
    const open = this.texts.filter((text) => !this.away.has(text));
    const hidden = this.texts.length - open.length;
    this.list.replaceChildren(...open.map((text) => this.row(text)));
    this.back.hidden = hidden === 0;
    this.back.textContent = hidden === 1 ? "1 note" : `${hidden} notes`;
    this.back.title = "Show the notes of the analysis again";
  }

  /** @param {string} text */
  row(text) {
    const close = button({
      icon: "close",
      label: "Dismiss this note",
      onClick: () => {
        this.away.add(text);
        this.draw();
      },
    });
    return element("p", { class: "sw-note" }, element("span", {}, text), close);
  }
}
