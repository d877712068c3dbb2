/** The error line below a picture. */

import { errorText } from "../host/error_text.js";
import { element } from "./element.js";

export class ErrorMessage {
  constructor() {
    this.node = element("div", { class: "sw-message", role: "alert", hidden: true });
    this.failure = ""; // error of the last drawing
  }

  /** Show a message as plain text, since a file name may hold HTML. @param {string} text "" hides the line */
  show(text) {
    this.node.hidden = !text;
    this.node.textContent = text;
  }

  /**
   * Draw. An error stays visible until drawing works again.
   *
   * @template T
   * @param {() => T} draw
   * @returns {T | null} null after an error
   */
  attempt(draw) {
    try {
      const drawn = draw();
      if (this.failure && this.node.textContent === this.failure) this.show("");
      this.failure = "";
      return drawn;
    } catch (error) {
      this.failure = errorText(error);
      this.show(this.failure);
      return null;
    }
  }
}
