/** A button that starts and stops an animation. */

import { button } from "./button.js";
import { icon } from "./icons.js";

const LONGEST = 0.2; // seconds between two steps, so that nothing jumps after a pause

/**
 * @param {{
 *   label: string,
 *   title: string,
 *   onStart?: () => void,
 *   onStep: (seconds: number) => boolean,
 *   onStop: () => void,
 * }} options `onStep` receives the time since the last step; returning false stops playback
 * @param {AbortSignal} signal
 */
export function playButton({ label, title, onStart, onStep, onStop }, signal) {
  const node = button({ icon: "play", label, title, onClick: () => (frame ? stop() : start()) });
  let frame = 0;
  let last = 0;
  const step = (/** @type {number} */ now) => {
    const passed = Math.min(LONGEST, (now - last) / 1000);
    last = now;
    if (!onStep(passed)) stop();
    else if (frame) frame = requestAnimationFrame(step);
  };
  const start = () => {
    onStart?.();
    last = performance.now();
    frame = requestAnimationFrame(step);
    show();
  };
  const stop = () => {
    if (!frame) return;
    cancelAnimationFrame(frame);
    frame = 0;
    onStop();
    show();
  };
  const show = () => {
    node.setAttribute("aria-pressed", String(frame !== 0));
    node.replaceChildren(icon(frame ? "pause" : "play"));
  };
  show();
  signal.addEventListener("abort", () => cancelAnimationFrame(frame));
  return { node, stop };
}
