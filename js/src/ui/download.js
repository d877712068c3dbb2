/** Downloads a file. */

import { element } from "./element.js";

const KEPT_MS = 60_000; // the browser reads the file while it asks where to save it

/** @param {Blob} blob @param {string} name */
export function download(blob, name) {
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  // Attach it to the page: VS Code only handles clicks that reach its document.
  link.hidden = true;
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), KEPT_MS);
}
