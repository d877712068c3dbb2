/** Hand a file to the person. */

import { element } from "../controls/element.js";

const KEPT_MS = 60_000; // the browser reads the file while it asks where to put it

/** @param {Blob} blob @param {string} name */
export function download(blob, name) {
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), KEPT_MS);
}
