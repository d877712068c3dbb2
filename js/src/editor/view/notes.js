/**
 * Notes under the picture about what the analysis could not determine. Each offers actions and can
 * be dismissed and shown again.
 */

import { equal } from "../../edit/equality.js";
import { button } from "../../ui/button.js";
import { element } from "../../ui/element.js";
import { assumedText, pointedText } from "../../ui/sun_words.js";
import { notesOf } from "./note_choice.js";

/**
 * @typedef {import("./note_choice.js").Note} Note
 * @typedef {import("./note_choice.js").NoteAction} NoteAction
 * @typedef {import("../types.js").Needs<"hand" | "picture" | "stage" | "state">} Answering
 */

const PASSING_SECONDS = 8;

/** @type {Record<NoteAction, { label: string, run: (needs: Answering, event: MouseEvent) => void }>} */
const ACTIONS = {
  pick: { label: "The sun is here …", run: (needs, event) => selectTool(needs, "pick", event) },
  not_sun: { label: "Not the sun", run: setSunOutside },
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
  horizon: { label: "Set the horizon", run: (needs, event) => selectTool(needs, "horizon", event) },
  paint: {
    label: "Paint the sky",
    run: (needs, event) => {
      needs.hand.setSubject("sky");
      selectTool(needs, "sky", event);
    },
  },
  leave: { label: "Never mind", run: (needs, event) => selectTool(needs, "sun", event) },
};

/** Record that the sun is not in the picture; a moved sun stays where it is. @param {Pick<Answering, "stage" | "state">} needs */
export function setSunOutside({ stage, state }) {
  state.set({ sun_hint: "outside" });
  stage.focus();
}

/** Select a tool and move the focus to where it is used. @param {Pick<Answering, "hand" | "stage">} needs @param {string} tool @param {MouseEvent} event */
export function selectTool({ hand, stage }, tool, event) {
  hand.setTool(tool);
  stage.node.scrollIntoView({ block: "nearest" });
  // After a key press there is no pointer: focus the handle or the cross.
  if (event.detail > 0) stage.focus();
  else if (hand.tools[tool].focus) hand.tools[tool].focus();
  else stage.node.focus({ preventScroll: true });
}

/**
 * @type {import("../types.js").MakePart<"announcer" | "statusBar" | "hand" | "kernel" | "notices"
 *   | "picture" | "stage" | "state">}
 */
export function notes({ announcer, statusBar, kernel, notices, ...answering }) {
  const { hand, picture, state } = answering;
  const list = element("div", { class: "sw-notes-list" });
  const back = element("button", { type: "button", class: "sw-notes-back", hidden: true });
  back.title = "Show the dismissed notes again";
  back.addEventListener("click", () => {
    dismissed.clear();
    draw(shown);
  });
  statusBar.node.append(element("div", { class: "sw-notes" }, list, back));
  /** @type {Set<string>} texts of dismissed notes */
  const dismissed = new Set();
  /** @type {Note[]} */
  let shown = [];
  /** The edit's sun hint that the scene reflects; undefined before there is a scene. */
  let followed = /** @type {unknown} */ (undefined);

  /** @param {Note} note */
  const row = ({ text, actions, stays = false }) => {
    const body = element("div", { class: "sw-note-said" }, element("span", {}, text));
    for (const name of actions) {
      const { label, run } = ACTIONS[name];
      const act = element("button", { type: "button", class: "sw-stage-action" }, label);
      act.addEventListener("click", (event) => run(answering, event));
      body.append(" ", act);
    }
    const node = element("div", { class: "sw-note" }, body);
    const onClick = () => {
      dismissed.add(text);
      draw(shown);
    };
    if (!stays) node.append(button({ icon: "close", label: "Dismiss this note", onClick }));
    return node;
  };

  /** @param {Note[]} all */
  const draw = (all) => {
    shown = all;
    const open = all.filter(({ text }) => !dismissed.has(text));
    const hidden = all.length - open.length;
    list.replaceChildren(...open.map(row));
    back.hidden = hidden === 0;
    back.textContent = hidden === 1 ? "1 note" : `${hidden} notes`;
  };

  /** Whether the assumed sun lies in the picture. @param {import("../../host/types.js").PhotoSun} sun */
  const isInside = ({ azimuth, elevation }) => {
    const { camera } = picture;
    const pixel = camera?.pixel(azimuth, elevation);
    if (!camera || !pixel) return false;
    const [x, y] = pixel;
    return x >= 0 && x < camera.width && y >= 0 && y < camera.height;
  };

  const update = () => {
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
    // A stand-alone page shows none: its readers cannot act on them.
    const all = scene && now && kernel.state !== "none" ? notesOf(scene, now) : [];
    if (!equal(all, shown)) draw(all);
    return now;
  };

  return {
    loaded(scene) {
      const before = followed;
      followed = state.values.sun_hint ?? null;
      const now = update();
      if (before === undefined || equal(before, followed) || !now) return;
      // Report that the new sun hint took effect, on screen or to screen readers.
      if (Array.isArray(followed)) {
        notices.show("sun", { text: pointedText(scene.sun), seconds: PASSING_SECONDS });
      } else if (followed) {
        announcer.say(assumedText(scene.sun, now), "sun note");
      }
    },
    show: () => void update(),
    draw: () => void update(),
  };
}
