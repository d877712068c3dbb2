/**
 * Make shader texts small for the bundle. They mean the same to a compiler, and every line stays
 * on its line, so that what a driver says of line 40 is found in line 40 of `shaders/`.
 *
 * Files include each other, so all are taken together: a name of the top level gets the same new
 * name wherever it stands, one of a function's own another. Left alone is what somebody else
 * knows by name: uniforms, fields of a struct, and whatever a directive mentions.
 */

const TOKEN =
  /\n|[A-Za-z_]\w*|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?[uUfF]?|<<=?|>>=?|[-+*/%<>=!&|^]=|\+\+|--|&&|\|\||\^\^|[^\s]/g;
const TYPE = /^(?:float|int|uint|bool|mat[234](?:x[234])?|[iub]?vec[234]|[iu]?sampler\w+)$/;
const QUALIFIER = /^(?:const|in|out|inout|flat|smooth|centroid|highp|mediump|lowp)$/;
const WORD = /^[A-Za-z_]/;
const LETTERS = "abcdefghijklmnopqrstuvwxyz";
const RESERVED = new Set(["do", "if", "in"]);

/**
 * @typedef {{ text: string, type?: boolean, local?: boolean }} Token
 * @typedef {string | Token[]} Line a directive's text, or what stands on a line
 */

/** Drop comments and indentation but no line. @param {string} text */
export function stripComments(text) {
  return text
    .replace(/\/\*[\s\S]*?\*\//g, (comment) => comment.replace(/[^\n]/g, ""))
    .replace(/\/\/[^\n]*/g, "")
    .replace(/^[ \t]+|[ \t]+$/gm, "");
}

/** @param {string} number as written: "1.50" and "1.0e-3" have digits that say nothing */
export function shortNumber(number) {
  const [, whole, fraction, rest] = /^(\d*)\.?(\d*)(.*)$/.exec(number) ?? [];
  if (!/[.eE]/.test(number)) return number; // an integer
  const short = fraction.replace(/0+$/, "");
  const start = short && whole === "0" ? "" : whole;
  return rest && !short ? `${start}${rest}` : `${start}.${short}${rest}`;
}

/** @param {number} n @param {string} last signs of the end; the signs before are letters */
const nthName = (n, last) => {
  let name = last[n % last.length];
  for (let i = Math.floor(n / last.length); i > 0; i = Math.floor((i - 1) / 26)) {
    name = LETTERS[(i - 1) % 26] + name;
  }
  return name;
};

/** Names in turn that nobody else has. @param {Set<string>} taken @param {string} last */
function* freshNames(taken, last) {
  for (let n = 0; ; n++) {
    const name = nthName(n, last);
    if (!taken.has(name) && !RESERVED.has(name)) yield name;
  }
}

/**
 * Macros that are another word for one word, in all files together.
 *
 * @param {string[]} texts
 */
function aliases(texts) {
  const lines = texts.flatMap((text) => text.split("\n").filter((line) => line.startsWith("#")));
  /** @type {Map<string, string>} */
  const found = new Map();
  for (const line of lines) {
    const [, name, word] = /^#define (\w+)[ \t]+([A-Za-z_]\w*)$/.exec(line) ?? [];
    if (name && lines.filter((other) => new RegExp(`\\b${name}\\b`).test(other)).length === 1) {
      found.set(name, word);
    }
  }
  return found;
}

/**
 * @param {string} text without comments
 * @param {Map<string, string>} alias
 * @returns {Line[]}
 */
const linesOf = (text, alias) =>
  text.split("\n").map((line) => {
    if (/^#.*\\$/.test(line)) throw new Error(`A directive must stand on one line: "${line}".`);
    if (!line.startsWith("#")) {
      return (line.match(TOKEN) ?? []).map((token) => ({ text: alias.get(token) ?? token }));
    }
    return alias.has(/^#define (\w+)/.exec(line)?.[1] ?? "") ? [] : line;
  });

/**
 * Ends of the functions of a file by their beginnings: from the bracket of the parameters to the
 * brace, or the semicolon, that ends it.
 *
 * @param {Token[]} tokens
 * @returns {[number, number][]}
 */
function functionsOf(tokens) {
  /** @type {[number, number][]} */
  const found = [];
  for (let i = 2, depth = 0; i < tokens.length; i++) {
    const { text } = tokens[i];
    if (text === "{" || text === "}") depth += text === "{" ? 1 : -1;
    if (depth || text !== "(" || !tokens[i - 2].type || !WORD.test(tokens[i - 1].text)) continue;
    let end = i;
    while (tokens[end].text !== ";" && tokens[end].text !== "{") end += 1;
    for (let open = tokens[end].text === "{" ? 1 : 0; open; ) {
      end += 1;
      open += { "{": 1, "}": -1 }[tokens[end].text] ?? 0;
    }
    found.push([i, end]);
    i = end;
  }
  return found;
}

/**
 * Names that a declaration from `at` on gives, which is the place of its first: after a comma
 * outside all brackets comes another.
 *
 * @param {Token[]} tokens
 * @param {number} at
 */
function declared(tokens, at) {
  const names = [tokens[at].text];
  for (let i = at + 1, depth = 0; i < tokens.length && depth >= 0; i++) {
    const { text } = tokens[i];
    if ("([{".includes(text)) depth += 1;
    else if (")]}".includes(text)) depth -= 1;
    else if (text === ";") break;
    else if (text === "," && depth === 0) {
      const next = tokens[i + 1];
      if (next.type || QUALIFIER.test(next.text) || !WORD.test(next.text)) break; // a parameter
      names.push(tokens[i + 1].text);
    }
  }
  return names;
}

/** Declarations from `start` to `end`, each with its place. @type {(tokens: Token[], start: number, end: number) => { at: number, names: string[] }[]} */
function declarations(tokens, start, end) {
  const found = [];
  for (let at = start; at < end; at++) {
    const isName = WORD.test(tokens[at].text) && !tokens[at].type;
    if (isName && tokens[at - 1]?.type) found.push({ at, names: declared(tokens, at) });
  }
  return found;
}

/**
 * @param {Record<string, string>} files shader texts by path: all that are expanded together
 * @returns {Record<string, string>} the same, small
 */
export function minify(files) {
  const paths = Object.keys(files);
  const plain = paths.map((path) => stripComments(files[path]));
  const alias = aliases(plain);
  const lines = plain.map((text) => linesOf(text, alias));
  const texts = lines.map(
    (rows) => /** @type {Token[]} */ (rows.flatMap((row) => (typeof row === "string" ? [] : row))),
  );

  const kept = new Set(["main", "SetConstants"]); // the second is called by program.js
  const structs = new Set();
  for (const tokens of texts) {
    tokens.forEach(({ text }, i) => {
      if (text === "." && tokens[i + 1]) kept.add(tokens[i + 1].text);
      if (text === "struct") structs.add(tokens[i + 1].text);
      if (text !== "uniform") return;
      const first = tokens.findIndex((token, at) => at > i && TYPE.test(token.text)) + 1;
      for (const name of declared(tokens, first)) kept.add(name);
    });
  }
  for (const row of lines.flat()) {
    for (const word of typeof row === "string" ? (row.match(/\w+/g) ?? []) : []) kept.add(word);
  }
  for (const token of texts.flat()) {
    token.type = TYPE.test(token.text) || token.text === "void" || structs.has(token.text);
  }

  // What stands at the top level, then what each function has of its own.
  /** @type {Map<string, number>} */
  const globals = new Map([...structs].map((name) => [name, 0]));
  const functions = texts.map(functionsOf);
  texts.forEach((tokens, i) => {
    const inside = (/** @type {number} */ at) => functions[i].some(([a, b]) => at > a && at < b);
    for (const { at, names } of declarations(tokens, 0, tokens.length)) {
      if (!inside(at)) for (const name of names) globals.set(name, 0);
    }
  });
  for (const name of kept) globals.delete(name);
  texts.forEach((tokens, i) => {
    for (const [start, end] of functions[i]) {
      const all = tokens.slice(start, end).map(({ text }) => text);
      // `float distance = distance(a, b)` names two things.
      const called = new Set(all.filter((_, at) => all[at + 1] === "("));
      const own = new Set(declarations(tokens, start, end).flatMap(({ names }) => names));
      const names = [...own].filter(
        (name) => ![kept, globals, called].some((set) => set.has(name)),
      );
      const fresh = freshNames(new Set(all.filter((name) => !names.includes(name))), LETTERS);
      const short = new Map(names.map((name) => [name, fresh.next().value]));
      for (let at = start; at < end; at++) {
        const name = short.get(tokens[at].text);
        if (!name || tokens[at - 1].text === ".") continue;
        tokens[at] = Object.assign(tokens[at], { text: name, local: true });
      }
    }
  });

  for (const { text, local } of texts.flat()) {
    if (!local && globals.has(text)) globals.set(text, (globals.get(text) ?? 0) + 1);
  }
  const order = [...globals].sort(([a, n], [b, m]) => m - n || (a < b ? -1 : 1));
  // They end in a capital and those of functions do not, so that neither hides the other.
  const written = new Set(texts.flat().map(({ text }) => text));
  const fresh = freshNames(written, LETTERS.toUpperCase());
  const short = new Map(order.map(([name]) => [name, fresh.next().value]));
  return Object.fromEntries(
    paths.map((path, i) => [path, lines[i].map((row) => lineText(row, short)).join("\n")]),
  );
}

/** @param {Line} row @param {Map<string, string>} short */
function lineText(row, short) {
  if (typeof row === "string") return row;
  let [line, last] = ["", ""];
  for (const { text, local } of row) {
    const next = local
      ? text
      : (short.get(text) ?? (/^[.\d]/.test(text) ? shortNumber(text) : text));
    // Two words would become one, and two signs another sign.
    const apart = /\w$/.test(last)
      ? /^[\w.]/.test(next) && next !== "."
      : /[-+&|<>=]$/.test(last) && last.endsWith(next[0]);
    line += apart ? ` ${next}` : next;
    last = next;
  }
  return line;
}
