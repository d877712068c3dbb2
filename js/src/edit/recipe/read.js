/**
 * A recipe from text: JSON, or Python as `Edit.to_code` and *Copy as Python* write it. The text
 * is read, never run: names, literals and calls of Edit, Stroke and Place are all there is.
 */

/** @typedef {import("../../host/types.js").Edit} Edit */

// Parameters of what a recipe's Python calls, in the order of their places.
const CALLS = {
  Edit: [],
  Stroke: ["label", "points", "radius"],
  Place: ["latitude", "longitude", "date", "time", "heading"],
};
const CONSTANTS = new Map(
  Object.entries({ None: null, True: true, False: false, null: null, true: true, false: false }),
);
const LONGEST = 20_000_000; // characters
const DEEPEST = 40; // brackets within brackets

/**
 * @param {string} text
 * @returns {Edit} as it stands there; `checkRecipe` says whether it can be used
 * @throws {Error} with a sentence for the person
 */
export function readRecipe(text) {
  if (text.length > LONGEST) throw new Error("This text is too long for a recipe.");
  const call = /\bEdit\s*\(/.exec(text);
  const value = call ? new Reader(text, call.index).value() : json(text);
  if (typeof value !== "object" || value === null || Array.isArray(value)) {
    throw new Error("There is no recipe in it: neither a JSON object nor sw.Edit(…).");
  }
  return value;
}

/** @param {string} text */
function json(text) {
  try {
    return JSON.parse(text);
  } catch {
    throw new Error("There is no recipe in it: neither a JSON object nor sw.Edit(…).");
  }
}

/** Reads one Python value, by recursive descent. */
class Reader {
  /** @param {string} text @param {number} at where the value begins */
  constructor(text, at) {
    this.text = text;
    this.at = at;
    this.depth = 0;
  }

  /** @returns {any} */
  value() {
    this.depth += 1;
    if (this.depth > DEEPEST) throw this.error("fewer brackets");
    const value = this.any();
    this.depth -= 1;
    return value;
  }

  /** @returns {any} */
  any() {
    const number = this.take(/[+-]?(?:\d[\d_]*\.?\d*|\.\d+)(?:[eE][+-]?\d+)?/y);
    if (number) return Number(number.replaceAll("_", ""));
    if (this.take(/\(/y)) return this.list(/\)/y);
    if (this.take(/\[/y)) return this.list(/\]/y);
    if (this.take(/\{/y)) return this.dictionary();
    const string = this.take(/"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*'/y);
    if (string) return unquoted(string);
    const name = this.take(/[A-Za-z_][\w.]*/y);
    if (!name) throw this.error("a value");
    if (CONSTANTS.has(name)) return CONSTANTS.get(name);
    const kind = /** @type {keyof typeof CALLS} */ (name.split(".").at(-1));
    if (!Object.hasOwn(CALLS, kind) || !this.take(/\(/y)) throw this.error("a plain value");
    return this.call(CALLS[kind]);
  }

  /** @param {RegExp} end @returns {any[]} */
  list(end) {
    const items = [];
    while (!this.take(end)) {
      items.push(this.value());
      if (!this.take(/,/y) && !this.peek(end)) throw this.error("a comma");
    }
    return items;
  }

  dictionary() {
    /** @type {[string, any][]} */
    const items = [];
    while (!this.take(/\}/y)) {
      const name = String(this.value());
      if (!this.take(/:/y)) throw this.error("a colon");
      items.push([name, this.value()]);
      if (!this.take(/,/y) && !this.peek(/\}/y)) throw this.error("a comma");
    }
    return Object.fromEntries(items);
  }

  /** Arguments as an object. @param {string[]} places names of those without one */
  call(places) {
    /** @type {[string, any][]} */
    const items = [];
    while (!this.take(/\)/y)) {
      const named = this.take(/[A-Za-z_]\w*\s*=(?!=)/y);
      const name = named ? named.replace(/\s*=$/, "") : places[items.length];
      if (!name) throw this.error("a parameter's name");
      items.push([name, this.value()]);
      if (!this.take(/,/y) && !this.peek(/\)/y)) throw this.error("a comma");
    }
    return Object.fromEntries(items);
  }

  /** What stands here, behind blanks and comments, or "". @param {RegExp} pattern sticky */
  take(pattern) {
    const found = this.peek(pattern);
    this.at += found.length;
    return found;
  }

  /** @param {RegExp} pattern sticky */
  peek(pattern) {
    const blank = /(?:\s|#[^\n]*|\\\r?\n)*/y;
    blank.lastIndex = this.at;
    this.at += blank.exec(this.text)?.[0].length ?? 0;
    pattern.lastIndex = this.at;
    return pattern.exec(this.text)?.[0] ?? "";
  }

  /** @param {string} wanted */
  error(wanted) {
    const line = this.text.slice(0, this.at).split("\n").length;
    const found = this.text.slice(this.at, this.at + 20).split("\n")[0] || "the end";
    return new Error(`Line ${line} of the recipe: ${wanted} is expected at “${found}”.`);
  }
}

/** @type {Record<string, string>} */
const ESCAPES = { n: "\n", t: "\t", r: "\r" };

/** @param {string} literal */
const unquoted = (literal) =>
  literal
    .slice(1, -1)
    .replace(/\\(?:U([0-9a-fA-F]{8})|u([0-9a-fA-F]{4})|(.))/g, (_, long, short, character) => {
      if (character) return ESCAPES[character] ?? character;
      const code = Number.parseInt(long ?? short, 16);
      return code > 0x10ffff ? "" : String.fromCodePoint(code);
    });
