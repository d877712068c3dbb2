/**
 * Pointers on the pictures: one drags the sun; the middle button, or any with the space bar held,
 * shifts all pictures; two fingers shift and zoom them; Ctrl or Cmd and the wheel zoom.
 */

/**
 * @typedef {import("./view.js").View} View
 * @typedef {import("./panel.js").Panel} Panel
 * @typedef {{ clientX: number, clientY: number }} Spot
 */

const WHEEL = 0.002; // what a CSS pixel of the wheel zooms by, as a logarithm
const LARGEST_NOTCH = 200; // CSS pixels

/**
 * @param {View} view
 * @param {Panel} panel
 * @param {AbortSignal} signal
 */
export function listenToPointer(view, panel, signal) {
  const { overlay, sun } = panel;
  /** @type {Map<number, Spot>} */
  const pointers = new Map();
  /** @type {"sun" | "pan" | ""} */
  let doing = "";

  /** @param {PointerEvent} event */
  const down = (event) => {
    if (event.button > 1 || !panel.scene) return;
    overlay.setPointerCapture(event.pointerId);
    event.preventDefault();
    pointers.set(event.pointerId, spot(event));
    if (pointers.size > 1) {
      // A second finger: what the first began was not meant.
      if (doing === "sun") sun.cancel();
      doing = "pan";
      return;
    }
    doing = event.button === 1 || view.root.classList.contains("sw-hand") ? "pan" : "sun";
    if (doing === "sun") sun.begin(panel.placeOf(event), event);
  };

  /** @param {PointerEvent} event */
  const move = (event) => {
    if (!pointers.has(event.pointerId)) return;
    const before = span([...pointers.values()]);
    pointers.set(event.pointerId, spot(event));
    if (doing === "sun") sun.move(panel.placeOf(event), event);
    else {
      const now = span([...pointers.values()]);
      view.zoom.pan(now.clientX - before.clientX, now.clientY - before.clientY);
      if (before.size && now.size) {
        view.zoom.zoomTo((view.zoom.scale * now.size) / before.size, panel.pointOf(now));
      }
      view.rezoomed();
    }
  };

  /** @param {PointerEvent} event */
  const lost = (event) => {
    pointers.delete(event.pointerId);
    if (pointers.size) return;
    if (doing === "sun") sun.end();
    doing = "";
  };

  /** @param {WheelEvent} event */
  const wheel = (event) => {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    const much = Math.min(LARGEST_NOTCH, Math.max(-LARGEST_NOTCH, event.deltaY));
    view.zoom.zoomTo(view.zoom.scale * Math.exp(-much * WHEEL), panel.pointOf(event));
    view.rezoomed();
  };

  overlay.addEventListener("pointerdown", down, { signal });
  overlay.addEventListener("pointermove", move, { signal });
  // The end of capture is the one end of a drag, whatever ended it.
  overlay.addEventListener("lostpointercapture", lost, { signal });
  overlay.addEventListener("pointercancel", () => sun.cancel(), { signal });
  overlay.addEventListener("wheel", wheel, { passive: false, signal });
}

/** @param {Spot} event @returns {Spot} */
const spot = ({ clientX, clientY }) => ({ clientX, clientY });

/** The middle of one or two fingers, and how far apart these are. @param {Spot[]} fingers */
const span = ([a, b = a]) => ({
  clientX: (a.clientX + b.clientX) / 2,
  clientY: (a.clientY + b.clientY) / 2,
  size: Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY),
});
