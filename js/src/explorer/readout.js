/** The line under the sky: the sun's position, and the sky under the pointer. */

import { trueElevation, turned } from "../geometry/day.js";
import { degrees } from "../ui/angle_text.js";
import { element } from "../ui/element.js";
import { cssColor } from "./color.js";
import { luminanceText } from "./sky_probe.js";

export class Readout {
  /** @param {(text: string) => void} say announces a moved sun */
  constructor(say) {
    this.say = say;
    this.sun = element("span", { class: "sw-readout" });
    this.swatch = element("span", { class: "sw-swatch" });
    this.text = element("span", {});
    this.note = element("span", { class: "sw-readout-note" });
    this.hover = element("span", { class: "sw-readout", hidden: true }, this.swatch, this.text);
    this.node = element("div", { class: "sw-foot" }, this.sun, this.note, this.hover);
  }

  /** @param {[number, number]} sun azimuth and apparent elevation */
  showSun([azimuth, elevation]) {
    const text =
      `Sun: azimuth ${degrees(turned(azimuth))} · elevation ${degrees(elevation)} as seen, ` +
      `${degrees(trueElevation(elevation))} without refraction`;
    if (this.sun.textContent && this.sun.textContent !== text) this.say(text);
    this.sun.textContent = text;
  }

  /** Show a note on the computation. @param {string} text */
  showNote(text) {
    if (this.note.textContent !== text) this.note.textContent = text;
  }

  /**
   * @param {[number, number] | null} direction azimuth and elevation
   * @param {import("./sky_probe.js").Reading | null} reading
   * @param {number} angle degrees from the sun
   */
  showHover(direction, reading, angle) {
    this.hover.hidden = !direction;
    if (!direction) return;
    const place =
      `azimuth ${degrees(turned(direction[0]))}, elevation ${degrees(direction[1])}, ` +
      `${degrees(angle, 0)} from the sun`;
    this.swatch.style.background = reading ? cssColor(reading.rgb) : "transparent";
    const color = reading?.xy
      ? ` · x ${reading.xy[0].toFixed(3)} y ${reading.xy[1].toFixed(3)}`
      : "";
    this.text.textContent = reading
      ? `${place} · ${luminanceText(reading.luminance)}${color}`
      : place;
  }
}
