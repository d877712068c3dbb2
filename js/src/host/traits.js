/**
 * Changes of traits, told when all that arrived with them is there. Hosts differ: JupyterLab takes
 * over a whole message before it tells anybody, marimo tells after each of its values, in any order.
 */

/**
 * @param {import("./types.js").Model} model
 * @param {string[]} names
 * @param {() => void} listener called once for all that changed together
 * @param {AbortSignal} signal ends it
 */
export function onTraits(model, names, listener, signal) {
  let due = false;
  const tell = () => {
    due = false;
    if (!signal.aborted) listener();
  };
  const onChange = () => {
    if (!due) queueMicrotask(tell);
    due = true;
  };
  for (const name of names) model.on(`change:${name}`, onChange);
  signal.addEventListener("abort", () => {
    for (const name of names) model.off(`change:${name}`, onChange);
  });
}
