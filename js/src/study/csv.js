/** Writes answers as a CSV file; the kernel's twin is `sunwidget/study/answers.py`. */

/**
 * @typedef {{ rater: string, trial: number, picture: string, left: string, right: string,
 *   choice: "left" | "right" | "tie", seconds: number, timestamp: string }} Answer
 */

/** @type {(keyof Answer)[]} */
const COLUMNS = ["rater", "trial", "picture", "left", "right", "choice", "seconds", "timestamp"];

/** @param {Answer[]} answers */
export function csv(answers) {
  const rows = [COLUMNS, ...answers.map((answer) => COLUMNS.map((name) => answer[name]))];
  return rows.map((row) => `${row.map(quoted).join(",")}\r\n`).join("");
}

/** @param {string | number} value */
function quoted(value) {
  const text = String(value);
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}
