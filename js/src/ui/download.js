/** Hand a file to the person. */

import { element } from "./element.js";

const KEPT_MS = 60_000; // the browser reads the file while it asks where to put it

/** @param {Blob} blob @param {string} name */
export function download(blob, name) {
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  // In the page: VS Code hands on the clicks that reach its document, and no others.
  link.hidden = true;
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), KEPT_MS);
}
