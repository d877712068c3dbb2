/** The toolbar: arrangement, history and zoom. */

import { equal } from "../edit/equality.js";
import { button, radioButtons } from "../ui/button.js";
import { element } from "../ui/element.js";
import { historyButtons } from "../ui/history_buttons.js";
import { zoomButtons } from "../ui/zoom_buttons.js";

/**
 * @param {import("./types.js").Needs<"hasOwnSuns" | "model" | "pair" | "setArrangement"
 *   | "setDifference" | "setPair" | "state" | "variants" | "wipes" | "zoom">} view
 */
export function toolbar(view) {
  const arrangement = radioButtons({
    label: "Arrangement",
    choices: [
      {
        value: "side_by_side",
        icon: "columns",
        label: "Side by side",
        title: "All side by side (W)",
      },
      { value: "wipe", icon: "split", label: "Wipe", title: "Two with a divider (W)" },
    ],
    value: view.model.get("arrangement"),
    onChange: (value) => view.setArrangement(value),
  });
  const selects = ["Left", "Right"].map((side, i) => {
    const select = element("select", { class: "sw-select", "aria-label": `${side} picture` });
    select.addEventListener("change", () => view.setPair(i, Number(select.value)));
    return select;
  });
  const pair = element("div", { class: "sw-group sw-compare-pair" }, ...selects);
  const history = historyButtons(view.state, "Back to the initial sun");
  const own = button({
    icon: "sun",
    label: "Own suns",
    title: "Draw each picture under the sun of its own recipe",
    caption: true,
    onClick: () => view.state.set({ one_sun: !view.state.values.one_sun }),
  });
  const difference = button({
    icon: "difference",
    label: "Difference",
    title: "How much each picture differs from the first (D)",
    caption: true,
    onClick: () => view.setDifference(!view.model.get("difference")),
  });
  const zoom = zoomButtons(view.zoom, "sw-group");
  const end = element("div", { class: "sw-group sw-end" }, own, difference, zoom.node);
  const node = element(
    "div",
    { class: "sw-toolbar", role: "group", "aria-label": "Comparison" },
    arrangement.node,
    pair,
    history.node,
    end,
  );
  return {
    node,
    show() {
      const { state, wipes } = view;
      const all = view.variants();
      arrangement.show(wipes ? "wipe" : "side_by_side");
      pair.hidden = !wipes || all.length < 3;
      selects.forEach((select, i) => {
        const labels = all.map(({ label }) => label);
        if (
          !equal(
            labels,
            [...select.options].map(({ text }) => text),
          )
        ) {
          select.replaceChildren(
            ...labels.map((label, value) => element("option", { value }, label)),
          );
        }
        select.value = String(view.pair[i]);
      });
      history.show();
      own.hidden = !view.hasOwnSuns();
      own.setAttribute("aria-pressed", String(!state.values.one_sun));
      difference.setAttribute("aria-pressed", String(Boolean(view.model.get("difference"))));
    },
    showZoom: zoom.show,
  };
}
