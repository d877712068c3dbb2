/**
 * A rater's pairs in random order and sides, the same whenever the same rater opens the same study,
 * even without a kernel.
 */

/**
 * @typedef {{ name: string, methods: { name: string, picture: number }[] }} Group pictures of one
 *   photo; `picture` is an index of the study's pictures
 * @typedef {{ name: string, picture: number }} Side
 * @typedef {{ group: string, left: Side, right: Side }} Trial
 */

/** Pseudo-random numbers in [0, 1) seeded by a text: FNV-1a, then mulberry32. @param {string} text */
export function chance(text) {
  let state = 0x811c9dc5;
  for (const byte of new TextEncoder().encode(text)) {
    state = Math.imul(state ^ byte, 0x01000193);
  }
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t = (t + Math.imul(t ^ (t >>> 7), t | 61)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

/**
 * Return every pair of each group `repeats` times, in rounds so that a pair does not repeat at once,
 * with sides swapped from round to round.
 *
 * @param {Group[]} groups
 * @param {{ seed: number, rater: string, repeats: number }} options
 * @returns {Trial[]}
 */
export function trials(groups, { seed, rater, repeats }) {
  const next = chance(`${seed} ${rater}`);
  const pairs = groups.flatMap(({ name, methods }) =>
    methods.flatMap((a, i) =>
      methods.slice(i + 1).map((b) => ({ group: name, sides: next() < 0.5 ? [a, b] : [b, a] })),
    ),
  );
  return Array.from({ length: repeats }, (_, round) =>
    shuffled(pairs, next).map(({ group, sides }) => ({
      group,
      left: sides[round % 2],
      right: sides[1 - (round % 2)],
    })),
  ).flat();
}

/**
 * @template T
 * @param {T[]} items
 * @param {() => number} next
 */
function shuffled(items, next) {
  const out = [...items];
  for (let i = out.length - 1; i > 0; i--) {
    const j = Math.floor(next() * (i + 1));
    [out[i], out[j]] = [out[j], out[i]];
  }
  return out;
}
