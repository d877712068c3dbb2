/** Filters parameters by search words, or to those that have changed. */

import { element } from "../../ui/element.js";
import { icon } from "../../ui/icons.js";

/**
 * @typedef {import("../../host/types.js").Parameter} Parameter
 * @typedef {{ parameter: Parameter, node: HTMLElement, show: () => void }} Row
 * @typedef {ReturnType<typeof import("../../ui/section.js").countedSection> & {
 *   name: string, rows: Row[], main: HTMLElement, more: HTMLDetailsElement | null,
 *   inMore: HTMLElement,
 * }} Section
 */

/**
 * @param {Pick<import("../../edit/state.js").EditState, "before">} state
 * @param {Section[]} sections
 * @param {{ isChanged: (p: Parameter) => boolean, isOpen: (name: string) => boolean }} options
 *   `isOpen` says whether a section is open when nothing is filtered
 */
export function panelFilter(state, sections, { isChanged, isOpen }) {
  const input = element("input", {
    type: "search",
    class: "sw-filter-field",
    placeholder: "Find a parameter",
    "aria-label": "Find a parameter",
    spellcheck: "false",
    autocomplete: "off",
  });
  const count = element("span", { class: "sw-count" });
  const changed = element(
    "button",
    { type: "button", class: "sw-chip sw-changed", "aria-pressed": "false" },
    "Changed",
    count,
  );
  const node = element(
    "div",
    { class: "sw-filter", role: "search" },
    element("span", { class: "sw-filter-box" }, icon("search"), input),
    changed,
  );
  const none = element("p", { class: "sw-filter-none", role: "status", hidden: true });
  let only = false;
  let filtered = false; // whether the sections currently show a selection

  const words = () => input.value.toLowerCase().split(/\s+/).filter(Boolean);
  const active = () => only || words().length > 0;

  /**
   * Whether a section's child passes the filter; children that a part added match by their text.
   *
   * @param {Element} child
   * @param {Section} section
   */
  const matches = (child, section) => {
    const row = section.rows.find((one) => one.node === child);
    if (only) {
      const focused = child.contains(child.ownerDocument.activeElement);
      if (!(row && (focused || isChanged(row.parameter)))) return false;
    }
    const p = row?.parameter;
    const text = p
      ? `${p.label} ${p.name.replaceAll("_", " ")} ${p.name} ${p.help}`
      : child.textContent;
    const searched = `${section.name} ${text}`.toLowerCase();
    return words().every((word) => searched.includes(word));
  };

  const apply = () => {
    const on = active();
    if (!on && !filtered) return;
    let found = false;
    for (const section of sections) {
      const { main, more } = section;
      const inMore = more ? [...(more.querySelector(".sw-section-body")?.children ?? [])] : [];
      /** @param {Element} child */
      const filterChild = (child) => {
        const passes = !on || matches(child, section);
        child.classList.toggle("sw-filtered", !passes);
        return passes;
      };
      const here = [...main.children].filter(filterChild).length;
      const there = inMore.filter(filterChild).length;
      if (more) {
        more.classList.toggle("sw-filtered", on && !there);
        if (on !== filtered || on) more.open = on && there > 0;
      }
      section.node.classList.toggle("sw-filtered", on && !here && !there);
      section.setOpen(on || isOpen(section.name));
      found ||= here + there > 0;
    }
    none.hidden = !on || found;
    if (!none.hidden) {
      none.textContent =
        only && !words().length ? "No parameter has been changed." : "No parameter matches.";
    }
    node.parentElement?.classList.toggle("sw-finding", on);
    filtered = on;
  };

  input.addEventListener("input", apply);
  input.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && active()) {
      input.value = "";
      setOnly(false);
      event.stopPropagation();
    }
  });
  /** @param {boolean} on */
  const setOnly = (on) => {
    only = on;
    changed.setAttribute("aria-pressed", String(on));
    apply();
    showCount();
  };
  changed.addEventListener("click", () => setOnly(!only));

  let counted = "";
  const showCount = () => {
    const rows = sections.flatMap((section) => section.rows);
    const some = rows.filter(({ parameter }) => isChanged(parameter)).length;
    if (counted === `${some} ${only}`) return;
    counted = `${some} ${only}`;
    count.textContent = some ? String(some) : "";
    count.hidden = !some;
    changed.disabled = !some && !only;
    changed.title = only ? "Show all parameters" : "Show only changed parameters";
  };

  return {
    node,
    none,
    active,
    focus: () => input.focus(),
    show() {
      showCount();
      // A row that passes its default during a drag stays visible.
      if (only && state.before === null) apply();
    },
  };
}
