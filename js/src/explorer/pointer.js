/** The pointer on the sky: it drags the sun, turns the view, and reads what lies under it. */

import { turned } from "../geometry/day.js";
import { GRAB } from "../ui/sun_shape.js";

/**
 * @typedef {import("../host/types.js").Point} Point
 * @typedef {import("./view.js").View} View
 */

/**
 * @param {View} view
 * @param {AbortSignal} signal
 */
export function listenToPointer(view, signal) {
  const { stage, state } = view;
  const { overlay } = stage;
  /** @type {number | null} */
  let pointer = null;
  /** @type {((place: Point) => void) | null} what a move does */
  let drag = null;

  /** @param {Point} start */
  const dragSun = (start) => {
    const sun = view.placeOf(view.sun.direction());
    const near = sun && Math.hypot(start[0] - sun[0], start[1] - sun[1]) < GRAB;
    const offset = near && sun ? [start[0] - sun[0], start[1] - sun[1]] : [0, 0];
    view.handle.node.focus({ preventScroll: true });
    return (/** @type {Point} */ [x, y]) => {
      // Losing the focus ends a gesture; a drag that goes on is the next one.
      state.begin();
      const direction = view.nearestDirection([x - offset[0], y - offset[1]]);
      if (direction) view.sun.moveTo(...direction);
    };
  };

  /** @param {Point} start */
  const turn = (start) => {
    const { view_azimuth, view_elevation } = state.values;
    const [azimuth, elevation] = [Number(view_azimuth), Number(view_elevation)];
    const perPixel = view.degreesPerPixel();
    const whole = state.values.projection === "camera";
    return (/** @type {Point} */ [x, y]) => {
      state.begin();
      state.set({
        view_azimuth: round(turned(azimuth - (x - start[0]) * perPixel)),
        ...(whole
          ? {
              view_elevation: view.clamp(
                "view_elevation",
                round(elevation + (y - start[1]) * perPixel),
              ),
            }
          : {}),
      });
    };
  };

  /** @param {Point} place */
  const grabsSun = (place) => {
    if (state.values.projection === "dome") return true;
    const box = stage.rectangle();
    const at = view.handle.onStage(...view.sun.direction(), box);
    return Math.hypot(box.x + place[0] - at.x, box.y + place[1] - at.y) < GRAB;
  };

  overlay.addEventListener(
    "pointerdown",
    (event) => {
      if (pointer !== null || event.button > 0) return;
      const place = stage.placeOf(event);
      pointer = event.pointerId;
      overlay.setPointerCapture(pointer);
      event.preventDefault();
      drag = grabsSun(place) ? dragSun(place) : turn(place);
      drag(place);
    },
    { signal },
  );
  overlay.addEventListener(
    "pointermove",
    (event) => {
      const place = stage.placeOf(event);
      view.hover(view.directionOf(place));
      if (event.pointerId === pointer) drag?.(place);
      else overlay.classList.toggle("sw-over-sun", grabsSun(place));
    },
    { signal },
  );
  overlay.addEventListener(
    "lostpointercapture",
    (event) => {
      if (event.pointerId !== pointer) return;
      pointer = null;
      drag = null;
      state.commit();
    },
    { signal },
  );
  overlay.addEventListener("pointercancel", () => state.cancel(), { signal });
  overlay.addEventListener("pointerleave", () => view.hover(null), { signal });
  // Plain wheel scrolls the page.
  overlay.addEventListener(
    "wheel",
    (event) => {
      if (state.values.projection !== "camera" || !(event.ctrlKey || event.metaKey)) return;
      event.preventDefault();
      const fov = Number(state.values.fov) * Math.exp(event.deltaY * 0.001);
      state.set({ fov: view.clamp("fov", round(fov)) });
    },
    { signal, passive: false },
  );
}

/** @param {number} degrees */
const round = (degrees) => Math.round(degrees * 100) / 100;
