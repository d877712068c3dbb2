/** The original photo, over the frame while "Before" is on, and beside it in a split. */

import { sameRecipe } from "../../edit/equality.js";

export class Original {
  /** @param {import("../types.js").Needs<"root" | "stage" | "state">} needs */
  constructor({ root, stage, state }) {
    this.root = root;
    this.stage = stage;
    this.state = state;
    this.before = false;
    this.split = false;
    /** @type {import("../../host/types.js").Edit} the edit when "Before" was turned on */
    this.hidden = {};
  }

  /** @param {boolean} on */
  setBefore(on) {
    if (on) this.hidden = this.state.recipe();
    this.before = on;
    this.show();
  }

  /** @param {boolean} on */
  setSplit(on) {
    this.split = on;
    this.show();
  }

  show() {
    this.stage.setOriginal(this.before || this.split);
    this.root.classList.toggle("sw-before", this.before);
    this.root.classList.toggle("sw-split", this.split);
  }

  /** Whether the edit that "Before" hides has changed. */
  isOutdated() {
    return this.before && !sameRecipe(this.hidden, this.state.recipe());
  }
}
