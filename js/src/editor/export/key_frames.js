/** A film's key frames, edits at given seconds, as a strip of thumbnails. */

import { alongEdit, movedOf } from "../../film/film_path.js";
import { button } from "../../ui/button.js";
import { chip } from "../../ui/chips.js";
import { element } from "../../ui/element.js";

/** @typedef {import("../../film/film_path.js").KeyFrame} KeyFrame */

// The same limits as in sunwidget/widgets/editor/key_frames.py.
const MOST = 100;
const LONGEST = 600;
const CLOSEST = 0.05;
const APART = 2; // seconds from the last key frame to a new one

/** @param {import("../types.js").Needs<"notices" | "state" | "thumbnails">} needs */
export function keyFrames({ notices, state, thumbnails }) {
  let generation = 0; // incremented with every scene
  /** @type {{ frame: KeyFrame, canvas: HTMLCanvasElement }[]} */
  let cards = [];

  const read = () => state.keyFrames();
  /** @param {KeyFrame[]} frames */
  const write = (frames) => {
    const sorted = [...frames].sort((a, b) => a.seconds - b.seconds);
    // No two share a time: the later one moves.
    let least = 0;
    const apart = sorted.map(({ seconds, recipe }) => {
      const at = round(Math.max(seconds, least));
      least = at + CLOSEST;
      return { seconds: at, recipe: movedOf(state.parameters, recipe) };
    });
    state.writeKeyFrames(apart);
  };

  /** @param {number} i @param {KeyFrame} frame */
  const put = (i, frame) => write(read().map((other, at) => (at === i ? frame : other)));

  const list = element("ol", { class: "sw-key-frames", "aria-label": "Key frames" });
  const add = chip("Add key frame", "Add the current edit as the film's next key frame", () => {
    const frames = read();
    const last = frames[frames.length - 1];
    write([...frames, { seconds: last ? last.seconds + APART : 0, recipe: state.recipe() }]);
    list.scrollLeft = list.scrollWidth;
  });
  const fromVersions = chip("From versions", "Use the versions as key frames, in order", () => {
    const before = read();
    write(state.versions().map(({ recipe }, i) => ({ seconds: i * APART, recipe })));
    if (before.length) offer("The key frames were replaced.", before);
  });
  const clear = chip(
    "Clear",
    "Remove all key frames: the film goes from the photo to the current edit",
    () => {
      const before = read();
      write([]);
      offer("The key frames were removed.", before);
    },
  );
  /** @param {string} text @param {KeyFrame[]} before */
  const offer = (text, before) =>
    notices.show("key-frame", {
      text,
      actions: [{ label: "Undo", run: () => write(before) }],
      seconds: 20,
    });
  const empty = element("p", { class: "sw-hint" });
  const node = element(
    "div",
    { class: "sw-key-frame-strip" },
    list,
    empty,
    element("div", { class: "sw-chips" }, add, fromVersions, clear),
  );

  /** @type {(frame: KeyFrame, i: number, all: KeyFrame[]) => HTMLElement} */
  const card = (frame, i, all) => {
    const canvas = element("canvas", { class: "sw-thumbnail", "aria-hidden": "true" });
    thumbnails.placePhoto(canvas);
    cards.push({ frame, canvas });
    const name = `key frame ${i + 1}`;
    const go = element(
      "button",
      { type: "button", class: "sw-key-go", "aria-label": `Go to ${name}` },
      canvas,
    );
    go.title = "Go to this edit, as one undo step";
    go.addEventListener("click", () => state.replace(whole(frame)));
    const seconds = element("input", {
      type: "number",
      class: "sw-input",
      min: 0,
      max: LONGEST,
      step: 0.1,
      value: frame.seconds,
      "aria-label": `Seconds of ${name}`,
    });
    seconds.addEventListener("keydown", (event) => {
      if (event.key === "Enter") seconds.blur();
      event.stopPropagation();
    });
    seconds.addEventListener("change", () => {
      const value = Number(seconds.value);
      const good = seconds.value !== "" && seconds.checkValidity();
      if (good) put(i, { ...frame, seconds: value });
      else seconds.value = String(frame.seconds);
    });
    /** @param {number} by */
    const move = (by) => {
      const frames = read();
      const other = frames[i + by];
      const swapped = [...frames];
      swapped[i] = { ...frame, recipe: other.recipe };
      swapped[i + by] = { ...other, recipe: frame.recipe };
      write(swapped);
      /** @type {HTMLElement | null} */ (list.children[i + by]?.querySelector("button"))?.focus();
    };
    const earlier = button({
      icon: "chevron",
      label: `Move ${name} earlier`,
      onClick: () => move(-1),
    });
    earlier.classList.add("sw-backwards");
    earlier.disabled = i === 0;
    const later = button({
      icon: "chevron",
      label: `Move ${name} later`,
      onClick: () => move(1),
    });
    later.disabled = i === all.length - 1;
    const retake = button({
      icon: "camera",
      label: `Set ${name} to the current edit`,
      onClick: () => put(i, { ...frame, recipe: state.recipe() }),
    });
    const remove = button({
      icon: "close",
      label: `Delete ${name}`,
      onClick: () => {
        const before = read();
        write(before.filter((_, at) => at !== i));
        offer("The key frame was deleted.", before);
        add.focus();
      },
    });
    const unit = element("span", { class: "sw-unit" }, "s");
    return element(
      "li",
      { class: "sw-key-frame" },
      go,
      element("div", { class: "sw-key-row" }, seconds, unit, remove),
      element("div", { class: "sw-key-row" }, earlier, retake, later),
    );
  };
  /** Complete a key frame's recipe with the current edit's corrections and methods. @param {KeyFrame} frame */
  const whole = (frame) => alongEdit(state.parameters, state.recipe(), frame.recipe);

  let drawn = "";
  const show = () => {
    const frames = read();
    const text = JSON.stringify(frames);
    if (text !== drawn || !cards.length) {
      drawn = text;
      cards = [];
      list.replaceChildren(...frames.map(card));
    }
    list.hidden = !frames.length;
    empty.hidden = frames.length > 1;
    empty.textContent = frames.length
      ? "The film goes from this key frame to the current edit. Move the sun and add the next."
      : "The film goes from the photo to the current edit, or through key frames that you add.";
    add.disabled = frames.length >= MOST;
    clear.hidden = !frames.length;
    fromVersions.hidden = state.versions().length < 2;
    small.wake();
  };
  const small = thumbnails.keep(node, () => {
    const shared = state.parameters.filter(({ kind }) => kind !== "data");
    return cards.map(({ frame, canvas }) => {
      const edit = alongEdit(state.parameters, state.values, frame.recipe);
      const key = JSON.stringify([generation, ...shared.map(({ name }) => edit[name])]);
      return { canvas, edit, key };
    });
  });

  return {
    node,
    read,
    write,
    show,
    loaded() {
      generation += 1;
      cards = [];
    },
    drawn: () => small.wake(),
  };
}

/** @param {number} seconds */
const round = (seconds) => Math.round(seconds * 100) / 100;
