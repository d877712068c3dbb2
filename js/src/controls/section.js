/** A section of the panel that folds. */

import { element } from "./element.js";
import { icon } from "./icons.js";

/**
 * @param {{ title: string, open?: boolean, className?: string }} options
 * @param {Node[]} children
 */
export function section({ title, open = true, className = "sw-section" }, ...children) {
  const body = element("div", { class: "sw-section-body" }, ...children);
  const heading = element("summary", {}, icon("chevron"), element("span", {}, title));
  return element("details", { class: className, open }, heading, body);
}
