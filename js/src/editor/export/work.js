/** Long work that the user waits for, one at a time: saving a picture or page, an export. */

import { Canceled } from "../../host/channel.js";
import { errorText } from "../../host/error_text.js";

export class Work {
  /** @param {import("../types.js").Needs<"notices" | "stage" | "state">} needs */
  constructor({ notices, stage, state }) {
    this.notices = notices;
    this.stage = stage;
    this.state = state;
    /** @type {AbortController | null} cancels the current work */
    this.controller = null;
    /** @type {() => void} called when work starts and ends */
    this.onChange = () => {};
  }

  get busy() {
    return this.controller !== null;
  }

  cancel() {
    this.controller?.abort();
  }

  /**
   * Run a piece of work, unless another is running.
   *
   * @param {string} what name shown to the user
   * @param {(signal: AbortSignal) => Promise<void>} make
   */
  async run(what, make) {
    if (this.busy) return;
    this.controller = new AbortController();
    this.state.push();
    this.onChange();
    try {
      await make(this.controller.signal);
      this.notices.hide("save");
    } catch (error) {
      this.notices.show("save", {
        text:
          error instanceof Canceled
            ? `${what} was canceled.`
            : `${what} failed: ${errorText(error)}`,
        actions: [{ label: "Try again", run: () => this.run(what, make) }],
      });
    } finally {
      this.controller = null;
      this.stage.setProgress(null, "");
      this.onChange();
    }
  }
}
