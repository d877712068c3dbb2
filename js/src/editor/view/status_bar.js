/** The line under the picture: where the sun stands, how sure the fitted sky is. */

import { sunText } from "../../ui/angle_text.js";
import { element } from "../../ui/element.js";

const SURENESS = "How likely the fitted sky is to change with the sun as the real one would";

/** Of a probability. A percentage would promise more than it says. @param {number} share */
const wordOf = (share) => (share >= 0.6 ? "fits well" : share >= 0.3 ? "fits roughly" : "a guess");

export class Foot {
  /** @param {import("./picture.js").Picture} picture */
  constructor(picture) {
    this.picture = picture;
    this.readout = element("div", { class: "sw-readout" });
    this.sureness = element("div", { class: "sw-sureness", title: SURENESS });
    this.node = element("div", { class: "sw-foot" }, this.readout, this.sureness);
  }

  /** What the analysis says of the photo. @param {import("../../host/types.js").Scene} scene */
  loaded({ sureness }) {
    this.sureness.textContent =
      typeof sureness === "number" ? `Atmosphere: ${wordOf(sureness)}` : "";
  }

  forget() {
    this.sureness.textContent = "";
  }

  draw() {
    if (!this.picture.scene) return;
    const [azimuth, elevation] = ["sun_azimuth", "sun_elevation"].map((name) =>
      this.picture.value(name),
    );
    this.readout.textContent = sunText(azimuth, elevation);
  }
}
