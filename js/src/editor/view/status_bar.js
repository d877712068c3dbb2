/** The line under the picture: the sun's position and the confidence of the fitted sky. */

import { sunText } from "../../ui/angle_text.js";
import { element } from "../../ui/element.js";

const CONFIDENCE = "How likely the fitted sky is to change with the sun as the real one would";

/** Describe a probability; a percentage would suggest more precision. @param {number} share */
const describeFit = (share) =>
  share >= 0.6 ? "fits well" : share >= 0.3 ? "fits roughly" : "a guess";

export class StatusBar {
  /** @param {import("./picture.js").Picture} picture */
  constructor(picture) {
    this.picture = picture;
    this.readout = element("div", { class: "sw-readout" });
    this.confidence = element("div", { class: "sw-sureness", title: CONFIDENCE });
    this.node = element("div", { class: "sw-foot" }, this.readout, this.confidence);
  }

  /** Show the confidence of a new analysis. @param {import("../../host/types.js").Scene} scene */
  loaded({ sureness }) {
    this.confidence.textContent =
      typeof sureness === "number" ? `Atmosphere: ${describeFit(sureness)}` : "";
  }

  forget() {
    this.confidence.textContent = "";
  }

  draw() {
    if (!this.picture.scene) return;
    const [azimuth, elevation] = ["sun_azimuth", "sun_elevation"].map((name) =>
      this.picture.value(name),
    );
    this.readout.textContent = sunText(azimuth, elevation);
  }
}
