/** The export panel under the picture: options for a still or a film. */

import { button } from "../../ui/button.js";
import { element, setAttributes } from "../../ui/element.js";
import { exportFilm } from "./export_film.js";
import { exportJob } from "./export_job.js";
import { exportStill } from "./export_still.js";

/**
 * @param {Parameters<typeof exportJob>[0] & Parameters<typeof exportFilm>[0]
 *   & import("../types.js").Needs<"statusBar" | "toolbar">} needs
 * @param {AbortSignal} signal
 * @returns {import("../part.js").Part}
 */
export function exportPanel({ statusBar, toolbar, ...needs }, signal) {
  const { channel, kernel } = needs;
  const id = `sw-export-${Math.random().toString(36).slice(2)}`;
  const trigger = button({
    icon: "chevron",
    label: "Export",
    title: "Export: format, size, layers, films (E)",
    onClick: () => setOpen(node.hidden !== false),
  });
  trigger.classList.add("sw-export-trigger");
  toolbar.save.after(trigger);
  toolbar.export = trigger;
  toolbar.menu.add({
    group: "picture",
    label: "Export …",
    title: "A still in any format and size, or a film",
    shown: () => kernel.state !== "none",
    run: () => setOpen(true),
  });

  const job = exportJob(needs, () => node.hidden === false, signal);
  const film = exportFilm(needs, job, signal);
  const pages = [
    { name: "Still", page: exportStill(needs, job) },
    { name: "Film", page: film },
  ].map(({ name, page }, i) => {
    const tab = element("button", { type: "button", role: "tab", class: "sw-tab" }, name);
    setAttributes(tab, { id: `${id}-${i}`, "aria-controls": `${id}-page-${i}` });
    setAttributes(page.node, {
      id: `${id}-page-${i}`,
      role: "tabpanel",
      "aria-labelledby": `${id}-${i}`,
    });
    tab.addEventListener("click", () => choose(i));
    return { tab, page };
  });
  const tabs = element("div", { role: "tablist", class: "sw-tabs", "aria-label": "Export" });
  tabs.append(...pages.map(({ tab }) => tab));
  tabs.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    choose((chosen + step + pages.length) % pages.length);
    pages[chosen].tab.focus();
  });
  const close = button({
    icon: "close",
    label: "Close the export panel",
    onClick: () => setOpen(false),
  });
  const node = element(
    "section",
    { class: "sw-export", id, "aria-label": "Export", hidden: true },
    element("div", { class: "sw-export-head" }, tabs, close),
    ...pages.map(({ page }) => page.node),
    job.running,
    job.done,
  );
  statusBar.node.after(node);
  trigger.setAttribute("aria-controls", id);

  let chosen = 0;
  /** @param {number} i */
  const choose = (i) => {
    chosen = i;
    for (const [at, { tab, page }] of pages.entries()) {
      setAttributes(tab, { "aria-selected": String(at === i), tabindex: at === i ? 0 : -1 });
      page.node.hidden = at !== i;
    }
    if (i === 0) film.stop();
    pages[i].page.show();
  };
  /** @param {boolean} open */
  const setOpen = (open) => {
    node.hidden = !open;
    trigger.setAttribute("aria-expanded", String(open));
    if (!open) {
      film.stop();
      (trigger.offsetParent ? trigger : toolbar.menu.trigger).focus();
      return;
    }
    choose(chosen);
    void ask();
    pages[chosen].tab.focus({ preventScroll: true });
    node.scrollIntoView({ block: "nearest" });
  };
  /** Ask the kernel what it can write, and where. */
  const ask = async () => {
    if (!kernel.answers) return;
    try {
      const { result } = await channel.request("exports");
      for (const { page } of pages) page.take(result);
    } catch {
      kernel.check();
    }
  };
  trigger.setAttribute("aria-expanded", "false");
  node.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    event.stopPropagation();
    setOpen(false);
  });
  const show = () => {
    trigger.hidden = kernel.state === "none";
    if (!node.hidden) pages[chosen].page.show();
  };
  choose(0);

  return {
    loaded() {
      film.loaded();
    },
    drawn: () => film.drawn(),
    show,
  };
}
