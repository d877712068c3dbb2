/** The pointer on the sky: drags the sun, turns the view, and reads the sky under it. */

import { turned } from "../geometry/day.js";
import { listenToPointers, wheelZoom } from "../ui/pointers.js";
import { GRAB } from "../ui/sun_shape.js";

/** @typedef {import("../host/types.js").Point} Point */

const WHEEL_SHARE = 0.5; // of a picture's zoom, since the range of fields of view is small

/**
 * @param {import("./types.js").Needs<"clamp" | "degreesPerPixel" | "directionOf" | "handle" | "hover"
 *   | "nearestDirection" | "placeOf" | "stage" | "state" | "sun">} view
 * @param {AbortSignal} signal
 */
export function listenToPointer(view, signal) {
  const { stage, state } = view;
  const { overlay } = stage;
  /** @type {(place: Point) => void} handles a move */
  let drag = () => {};

  /** Convert a place of the picture to its CSS pixels. @param {Point} place @returns {Point} */
  const pixels = ([x, y]) => {
    const { width, height } = stage.rectangle();
    return [x * width, y * height];
  };

  /** @param {Point} start */
  const dragSun = (start) => {
    const sun = view.placeOf(view.sun.direction());
    const near = sun && Math.hypot(start[0] - sun[0], start[1] - sun[1]) < GRAB;
    const offset = near && sun ? [start[0] - sun[0], start[1] - sun[1]] : [0, 0];
    view.handle.node.focus({ preventScroll: true });
    return (/** @type {Point} */ [x, y]) => {
      // Losing the focus ends a gesture; a drag that continues is a new one.
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

  listenToPointers(
    stage,
    {
      tool: () => ({
        begin(start) {
          const place = pixels(start);
          drag = grabsSun(place) ? dragSun(place) : turn(place);
          drag(place);
        },
        move: (place) => drag(pixels(place)),
        end: () => state.commit(),
        cancel: () => state.cancel(),
      }),
      onPoint(at, free) {
        const place = at && pixels(at);
        view.hover(place && view.directionOf(place));
        if (free && place) overlay.classList.toggle("sw-over-sun", grabsSun(place));
      },
    },
    signal,
  );
  // The plain wheel scrolls the page.
  overlay.addEventListener(
    "wheel",
    (event) => {
      if (state.values.projection !== "camera" || !(event.ctrlKey || event.metaKey)) return;
      event.preventDefault();
      const fov = Number(state.values.fov) * Math.exp(-WHEEL_SHARE * wheelZoom(event));
      state.set({ fov: view.clamp("fov", round(fov)) });
    },
    { signal, passive: false },
  );
}

/** @param {number} degrees */
const round = (degrees) => Math.round(degrees * 100) / 100;
