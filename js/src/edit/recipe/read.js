/** A recipe from text. JSON is read here, Python by the kernel; neither is run. */

const LONGEST = 5_000_000; // characters of Python: a message of 10 MiB would break the connection

/**
 * @param {string} text
 * @param {(text: string) => Promise<unknown>} readPython
 * @returns {Promise<unknown>} as it stands there; `checkRecipe` says whether it can be used
 * @throws {Error} with a sentence for the person
 */
export async function readRecipe(text, readPython) {
  try {
    return JSON.parse(text);
  } catch {
    if (!/\bEdit\s*\(/.test(text)) {
      throw new Error("No recipe found: the text is neither a JSON object nor sw.Edit(…).");
    }
    if (text.length > LONGEST) throw new Error("This Python is too long for a recipe.");
    return readPython(text);
  }
}
