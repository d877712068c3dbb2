/**
 * What the analysis could not know, under the picture: each note says it in words, offers what can
 * be done about it, and can be put away and brought back.
 */

import { equal } from "../../edit/equality.js";
import { button } from "../../ui/button.js";
import { element } from "../../ui/element.js";
import { assumedText, pointedText } from "../../ui/sun_words.js";
import { notesOf } from "./note_choice.js";

/**
 * @typedef {import("./note_choice.js").Note} Note
 * @typedef {import("./note_choice.js").NoteAction} NoteAction
 * @typedef {import("./view.js").View} View
 */

const PASSING_SECONDS = 8;

/** @type {Record<NoteAction, { label: string, run: (view: View, event: MouseEvent) => void }>} */
const ACTIONS = {
  pick: { label: "The sun is here …", run: (view, event) => take(view, "pick", event) },
  not_sun: { label: "Not the sun", run: (view) => sayOutside(view) },
  take_back: {
    label: "Undo that",
    run: ({ state }) => {
      const now = state.values.sun_hint;
      const steps = [...state.history().past].reverse();
      const before = steps.find(({ sun_hint = null }) => !equal(sun_hint, now));
      state.set({ sun_hint: before?.sun_hint ?? null });
    },
  },
  moon_is_sun: {
    label: "It is the sun",
    run: ({ picture, state }) => state.set({ sun_hint: picture.scene?.sun.moon ?? null }),
  },
  horizon: { label: "Set the horizon", run: (view, event) => take(view, "horizon", event) },
  paint: {
    label: "Paint the sky",
    run: (view, event) => {
      view.hand.setSubject("sky");
      take(view, "sky", event);
    },
  },
  leave: { label: "Never mind", run: (view, event) => take(view, "sun", event) },
};

/** Say that nothing in the picture is the sun; a sun that was moved stays where it is. @param {View} view */
export function sayOutside(view) {
  view.state.set({ sun_hint: "outside" });
  view.stage.focus();
}

/** Choose a tool and go where it is used. @param {View} view @param {string} tool @param {MouseEvent} event */
export function take(view, tool, event) {
  view.hand.setTool(tool);
  view.stage.node.scrollIntoView({ block: "nearest" });
  // Who pressed a key has no pointer to go on with, and gets the handle or the cross.
  if (event.detail > 0) view.stage.focus();
  else if (view.hand.tools[tool].focus) view.hand.tools[tool].focus();
  else view.stage.node.focus({ preventScroll: true });
}

/** @type {import("../parts.js").MakePart} */
export function notes(view) {
  const list = element("div", { class: "sw-notes-list" });
  const back = element("button", { type: "button", class: "sw-notes-back", hidden: true });
  back.title = "Show the notes of the analysis again";
  back.addEventListener("click", () => {
    away.clear();
    draw(shown);
  });
  view.foot.node.append(element("div", { class: "sw-notes" }, list, back));
  /** @type {Set<string>} texts that were put away */
  const away = new Set();
  /** @type {Note[]} */
  let shown = [];
  /** What the edit says of the sun, as the scene follows it; undefined before there is one. */
  let followed = /** @type {unknown} */ (undefined);

  /** @param {Note} note */
  const row = ({ text, actions, stays = false }) => {
    const said = element("div", { class: "sw-note-said" }, element("span", {}, text));
    for (const name of actions) {
      const { label, run } = ACTIONS[name];
      const act = element("button", { type: "button", class: "sw-stage-action" }, label);
      act.addEventListener("click", (event) => run(view, event));
      said.append(" ", act);
    }
    const node = element("div", { class: "sw-note" }, said);
    const onClick = () => {
      away.add(text);
      draw(shown);
    };
    if (!stays) node.append(button({ icon: "close", label: "Dismiss this note", onClick }));
    return node;
  };

  /** @param {Note[]} all */
  const draw = (all) => {
    shown = all;
    const open = all.filter(({ text }) => !away.has(text));
    const hidden = all.length - open.length;
    list.replaceChildren(...open.map(row));
    back.hidden = hidden === 0;
    back.textContent = hidden === 1 ? "1 note" : `${hidden} notes`;
  };

  /** Whether the assumed sun lies in the picture. @param {import("../../host/types.js").PhotoSun} sun */
  const isInside = ({ azimuth, elevation }) => {
    const { camera } = view.picture;
    const pixel = camera?.pixel(azimuth, elevation);
    if (!camera || !pixel) return false;
    const [x, y] = pixel;
    return x >= 0 && x < camera.width && y >= 0 && y < camera.height;
  };

  const look = () => {
    const { kernel, hand, picture, state } = view;
    const { scene } = picture;
    if (!scene) followed = undefined;
    const hint = state.values.sun_hint ?? null;
    const now = scene && {
      live: kernel.answers,
      inside: isInside(scene.sun),
      picking: hand.tool === "pick",
      pending: !equal(hint, followed),
      hint,
    };
    // A page's notes are its maker's: nobody who reads it can answer them.
    const all = scene && now && kernel.state !== "none" ? notesOf(scene, now) : [];
    if (!equal(all, shown)) draw(all);
    return now;
  };

  return {
    loaded(scene) {
      const before = followed;
      followed = view.state.values.sun_hint ?? null;
      const now = look();
      if (before === undefined || equal(before, followed) || !now) return;
      // What was said of the sun is done: the status says so, to the eye and aloud.
      if (Array.isArray(followed)) {
        view.notices.show("sun", { text: pointedText(scene.sun), seconds: PASSING_SECONDS });
      } else if (followed) {
        view.announcer.say(assumedText(scene.sun, now), "sun note");
      }
    },
    show: () => void look(),
    draw: () => void look(),
  };
}
