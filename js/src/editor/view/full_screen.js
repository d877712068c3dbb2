/**
 * The editor on all of the screen. Where a host forbids that (a frame without the permission, a
 * phone), the editor fills its window instead.
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
    this.root.addEventListener("fullscreenchange", () => this.changed(), { signal });
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
      this.fill();
    }
  }

  /** Over the whole window: in the top layer, whatever the host's boxes clip or move. */
  fill() {
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

  /** The browser has entered or left; Escape leaves, too. */
  changed() {
    this.show(this.isFullScreen());
  }

  /** @param {boolean} on */
  show(on) {
    this.on = on;
    this.root.classList.toggle("sw-full", on);
    this.button.setAttribute("aria-pressed", String(on));
  }
}
