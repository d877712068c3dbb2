/** Reads a recipe from text: JSON here, Python in the kernel. Neither is executed. */

const LONGEST = 5_000_000; // characters of Python: a message of 10 MiB would break the connection

/**
 * @param {string} text
 * @param {(text: string) => Promise<unknown>} readPython
 * @returns {Promise<unknown>} unchecked; pass it to `checkRecipe`
 * @throws {Error} with a message for the user
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
