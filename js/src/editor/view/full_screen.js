/**
 * Full screen. Where a host forbids it (a frame without permission, a phone), the editor fills its
 * window instead.
 */

import { button } from "../../ui/button.js";

export class FullScreen {
  /**
   * @param {import("../types.js").Needs<"root" | "toolbar">} needs
   * @param {AbortSignal} signal
   */
  constructor({ root, toolbar }, signal) {
    this.root = root;
    this.on = false;
    this.button = button({
      icon: "full_screen",
      label: "Full screen",
      title: "Full screen (F)",
      onClick: () => void this.toggle(),
    });
    this.button.setAttribute("aria-pressed", "false");
    toolbar.end.append(this.button);
    this.root.addEventListener("fullscreenchange", () => this.onBrowserChange(), { signal });
    signal.addEventListener("abort", () => {
      if (this.isFullScreen()) void document.exitFullscreen();
    });
  }

  async toggle() {
    if (this.on) return this.leave();
    try {
      await this.root.requestFullscreen();
      this.show(true);
    } catch {
      this.fillWindow();
    }
  }

  /** Fill the window, in the top layer so that the host's boxes cannot clip it. */
  fillWindow() {
    if (this.root.showPopover) {
      this.root.popover = "manual";
      this.root.showPopover();
    }
    this.show(true);
  }

  leave() {
    if (this.isFullScreen()) void document.exitFullscreen();
    else {
      this.root.removeAttribute("popover");
      this.show(false);
    }
  }

  isFullScreen() {
    return this.root.matches(":fullscreen");
  }

  /** Follow the browser entering or leaving full screen, also with Escape. */
  onBrowserChange() {
    this.show(this.isFullScreen());
  }

  /** @param {boolean} on */
  show(on) {
    this.on = on;
    this.root.classList.toggle("sw-full", on);
    this.button.setAttribute("aria-pressed", String(on));
  }
}
