/**
 * Reports trait changes once all changes of a message have arrived. Hosts differ: JupyterLab applies a
 * whole message before it fires events, marimo fires after each value, in any order.
 */

/**
 * @param {import("./types.js").Model} model
 * @param {string[]} names
 * @param {() => void} listener called once for all traits that changed together
 * @param {AbortSignal} signal ends it
 */
export function onTraits(model, names, listener, signal) {
  let due = false;
  const notify = () => {
    due = false;
    if (!signal.aborted) listener();
  };
  const onChange = () => {
    if (!due) queueMicrotask(notify);
    due = true;
  };
  for (const name of names) model.on(`change:${name}`, onChange);
  signal.addEventListener("abort", () => {
    for (const name of names) model.off(`change:${name}`, onChange);
  });
}
