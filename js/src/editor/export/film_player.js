/** Plays a film in the view's picture: each moment is drawn live, and the edit does not change. */

import { sameRecipe } from "../../edit/equality.js";
import { element } from "../../ui/element.js";
import { playButton } from "../../ui/play_button.js";

/**
 * @typedef {{ path: import("../../film/film_path.js").FilmPath, seconds: number, loop: string }} Film
 *   `loop`: once, forever or there_and_back
 */

/**
 * @param {import("../types.js").Needs<"drawing" | "parts" | "picture" | "stage" | "state">} needs
 * @param {AbortSignal} signal
 * @param {() => Film | null} read returns the film with the current settings; null when nothing moves
 */
export function filmPlayer({ drawing, parts, picture, stage, state }, signal, read) {
  const range = element("input", {
    type: "range",
    class: "sw-range",
    min: 0,
    max: 1,
    step: "any",
    value: 0,
    "aria-label": "Position in the film",
  });
  const time = element("span", { class: "sw-film-time" });

  let at = 0; // seconds
  let way = 1;
  /** @type {import("../../host/types.js").Edit} the edit when playback started */
  let under = {};

  /** @param {Film} film */
  const draw = (film) => {
    if (!picture.passing) under = state.recipe();
    picture.passing = film.path(Math.min(1, at / film.seconds));
    drawing.loop.request();
    show();
  };
  /** Show the edit again. */
  const leave = () => {
    if (!picture.passing) return;
    picture.passing = null;
    at = 0;
    parts.show();
  };
  const play = playButton(
    {
      label: "Play the film",
      title: "Play the film in the picture; the edit does not change",
      onStart: () => {
        if (at >= (read()?.seconds ?? 0)) at = 0;
        way = 1;
      },
      onStep: (seconds) => {
        const film = read();
        if (film) at += (way * seconds) % film.seconds;
        if (!film || (film.loop === "once" && at > film.seconds)) {
          leave();
          return false;
        }
        if (at > film.seconds || at < 0) {
          const back = film.loop === "there_and_back";
          if (back) way = at < 0 ? 1 : -1;
          at = back ? (at < 0 ? -at : 2 * film.seconds - at) : at - film.seconds;
        }
        draw(film);
        return true;
      },
      onStop: () => show(),
    },
    signal,
  );
  const stop = () => {
    play.stop();
    leave();
  };
  const node = element("div", { class: "sw-film-player", role: "group", "aria-label": "Film" });
  node.append(play.node, range, time);
  range.addEventListener("input", () => {
    const film = read();
    if (!film) return;
    play.stop();
    at = Number(range.value) * film.seconds;
    draw(film);
  });
  // A press on the picture or a panel's slider concerns the edit.
  stage.node.addEventListener("pointerdown", stop, { capture: true, signal });

  const show = () => {
    const film = read();
    play.node.disabled = range.disabled = !film;
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
      if (picture.passing && (state.before || !sameRecipe(under, state.recipe()))) stop();
      else show();
    },
  };
}
