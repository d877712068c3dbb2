/** The sun's handle on the sky: drag it, even below the horizon, or move it with the arrow keys. */

import { turned } from "../geometry/day.js";
import { EDGE, keyStep, SunShape, spotOnStage } from "../ui/sun_shape.js";

// Around the dome there is room for all of twilight.
const DOME_EDGE = 12;

export class SunHandle {
  /** @param {import("./types.js").Needs<"parameter" | "placeOf" | "stage" | "state" | "sun">} view */
  constructor(view) {
    this.view = view;
    this.shape = new SunShape();
    this.node = this.shape.node;
    this.node.addEventListener("keydown", (event) => this.onKey(event));
    for (const end of ["keyup", "blur"]) {
      this.node.addEventListener(end, () => view.state.commit());
    }
  }

  /** @param {KeyboardEvent} event */
  onKey(event) {
    const step = keyStep(event);
    if (!step) return;
    // On the dome, seen from below, east is to the left.
    const side = this.view.state.values.projection === "dome" ? -1 : 1;
    const [azimuth, elevation] = this.view.sun.direction();
    this.view.state.begin();
    this.view.sun.moveTo(azimuth + side * step[0], elevation + step[1]);
  }

  draw() {
    const { view } = this;
    const [azimuth, elevation] = view.sun.direction();
    const spot = this.onStage(azimuth, elevation, view.stage.rectangle());
    this.shape.show(spot, [turned(azimuth), elevation], view.parameter("sun_elevation"));
  }

  /**
   * @param {number} azimuth
   * @param {number} elevation
   * @param {import("../ui/stage.js").Box} box
   */
  onStage(azimuth, elevation, box) {
    const place = this.view.placeOf([azimuth, elevation]);
    const [dx, dy] = place
      ? [place[0] - box.width / 2, place[1] - box.height / 2]
      : // Behind the camera: the side to turn toward.
        [turned(azimuth - Number(this.view.state.values.view_azimuth)) < 0 ? -1e6 : 1e6, 0];
    const dome = this.view.state.values.projection === "dome";
    return spotOnStage(box, dx, dy, dome ? DOME_EDGE : EDGE);
  }
}
