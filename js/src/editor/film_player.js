/** Plays a film in the view's own picture: each moment is drawn live, and the edit stays as it is. */

import { button } from "../controls/button.js";
import { element } from "../controls/element.js";
import { icon } from "../controls/icons.js";
import { sameRecipe } from "../same.js";

/**
 * @typedef {{ path: import("../film_path.js").FilmPath, seconds: number, loop: string }} Film
 *   `loop`: once, forever or there_and_back
 */

/**
 * @param {import("./view.js").View} view
 * @param {AbortSignal} signal
 * @param {() => Film | null} read the film as it is set now; null when nothing moves
 */
export function filmPlayer(view, signal, read) {
  const { state } = view;
  const play = button({ icon: "play", label: "Play the film", onClick: () => toggle() });
  const range = element("input", {
    type: "range",
    class: "sw-range",
    min: 0,
    max: 1,
    step: "any",
    value: 0,
    "aria-label": "Moment of the film",
  });
  const time = element("span", { class: "sw-film-time" });
  const node = element("div", { class: "sw-film-player", role: "group", "aria-label": "Film" });
  node.append(play, range, time);

  let at = 0; // seconds
  let way = 1;
  let frame = 0;
  let last = 0;
  /** @type {import("../types.js").Edit} the edit under which the film is shown */
  let under = {};

  /** @param {Film} film */
  const draw = (film) => {
    if (!view.passing) under = state.recipe();
    view.passing = film.path(Math.min(1, at / film.seconds));
    view.loop.request();
    show();
  };
  const tick = (/** @type {number} */ now) => {
    const film = read();
    if (!film) return stop();
    at += (way * Math.min(0.2, (now - last) / 1000)) % film.seconds;
    last = now;
    if (at > film.seconds || at < 0) {
      if (film.loop === "once") return stop();
      const back = film.loop === "there_and_back";
      if (back) way = at < 0 ? 1 : -1;
      at = back ? (at < 0 ? -at : 2 * film.seconds - at) : at - film.seconds;
    }
    draw(film);
    frame = requestAnimationFrame(tick);
  };
  const toggle = () => {
    if (frame) return pause();
    const film = read();
    if (!film) return;
    if (at >= film.seconds) at = 0;
    way = 1;
    last = performance.now();
    frame = requestAnimationFrame(tick);
    show();
  };
  const pause = () => {
    cancelAnimationFrame(frame);
    frame = 0;
    show();
  };
  /** Back to the edit. */
  const stop = () => {
    if (frame) pause();
    if (!view.passing) return;
    view.passing = null;
    at = 0;
    view.show();
  };
  range.addEventListener("input", () => {
    const film = read();
    if (!film) return;
    at = Number(range.value) * film.seconds;
    pause();
    draw(film);
  });
  // A hand on the picture or a panel's slider means the edit.
  view.stage.node.addEventListener("pointerdown", stop, { capture: true, signal });
  signal.addEventListener("abort", pause);

  const show = () => {
    const film = read();
    const playing = frame !== 0;
    play.disabled = range.disabled = !film;
    play.title = play.ariaLabel = playing ? "Pause the film" : "Play the film";
    play.setAttribute("aria-pressed", String(playing));
    play.replaceChildren(icon(playing ? "pause" : "play"));
    const seconds = film?.seconds ?? 0;
    const share = seconds ? Math.min(1, at / seconds) : 0;
    range.value = String(share);
    range.style.setProperty("--sw-share", String(share));
    range.setAttribute("aria-valuetext", `${at.toFixed(1)} of ${seconds.toFixed(1)} seconds`);
    time.textContent = `${at.toFixed(1)} / ${seconds.toFixed(1)} s`;
  };

  return {
    node,
    stop,
    show() {
      if (view.passing && (state.before || !sameRecipe(under, state.recipe()))) stop();
      else show();
    },
  };
}
