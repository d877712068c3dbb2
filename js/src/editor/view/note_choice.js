/** Chooses the notes under the picture and their actions. */

import { assumedText, DOUBTED, doubtText } from "../../ui/sun_words.js";

/**
 * @typedef {"pick" | "not_sun" | "take_back" | "moon_is_sun" | "horizon" | "paint" | "leave"} NoteAction
 * @typedef {{ text: string, actions: NoteAction[], stays?: boolean }} Note `stays`: it cannot be dismissed
 * @typedef {{
 *   live: boolean, inside: boolean, picking: boolean, pending: boolean, hint: unknown,
 * }} Now `live`: a kernel answers; `inside`: the assumed sun lies in the picture; `picking`: the
 *   tool that marks the sun is selected; `pending`: the scene does not reflect the edit's sun hint
 *   yet; `hint`: that hint
 */

/** Actions for each note of the analysis. @type {Record<string, NoteAction[]>} */
const ACTIONS = {
  sky: ["paint"],
  unseen_sun: ["pick"],
  told_outside: ["take_back", "pick"],
  doubtful_sun: ["not_sun", "pick"],
  moon: ["moon_is_sun"],
  night_sun: ["take_back"],
  sun_mask: ["pick", "not_sun"],
  horizon: ["horizon"],
};
const SUN_NOTES = ["unseen_sun", "told_outside", "doubtful_sun", "moon", "night_sun", "sun_mask"];

/** @type {Note} */
const PICKING = {
  text: "Click where the photo’s sun is. It may be hidden or outside the picture.",
  actions: ["leave"],
  stays: true,
};

/**
 * @param {Pick<import("../../host/types.js").Scene, "notes" | "sun">} scene
 * @param {Now} now
 * @returns {Note[]}
 */
export function notesOf({ notes, sun }, now) {
  const rows = [...notes];
  if (sun.source === "found" && sun.confidence < DOUBTED) {
    rows.unshift({ about: "doubtful_sun", text: doubtText(sun) });
  }
  // Hide notes about the sun while it is being set again.
  const outdated = now.picking || now.pending;
  const chosen = rows.filter(({ about }) => !outdated || !SUN_NOTES.includes(about));
  const shown = chosen.map(({ about, text }) => ({
    text: about === "unseen_sun" || about === "told_outside" ? assumedText(sun, now) : text,
    actions: (now.live ? (ACTIONS[about] ?? []) : []).filter(
      (action) => action !== "take_back" || now.hint !== null,
    ),
  }));
  return now.picking ? [PICKING, ...shown] : shown;
}
