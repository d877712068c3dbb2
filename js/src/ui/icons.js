/** Line icons on a 20 × 20 grid, drawn in the text color. */

import { shape } from "./element.js";

const PATHS = {
  sun: "M10 6.2a3.8 3.8 0 1 0 0 7.6 3.8 3.8 0 0 0 0-7.6ZM10 1.5v2M10 16.5v2M1.5 10h2M16.5 10h2M4 4l1.4 1.4M14.6 14.6 16 16M4 16l1.4-1.4M14.6 5.4 16 4",
  horizon:
    "M1.5 12.5h17M5.5 12.5a4.5 4.5 0 0 1 9 0M10 3.5v2M3.8 6.2l1.3 1.3M16.2 6.2l-1.3 1.3M5 16h10",
  pick: "M10 2v4M10 14v4M2 10h4M14 10h4M10 9.2v1.6M9.2 10h1.6",
  sky: "M9.8 3.2 13.4 6.8 7 13.2 3 14.4l1-4ZM8.4 4.6 12 8.2M12 15h5M14.5 12.5v5",
  not_sky: "M9.8 3.2 13.4 6.8 7 13.2 3 14.4l1-4ZM8.4 4.6 12 8.2M12 15h5",
  water:
    "M2 6.5c2-2 4-2 6 0s4 2 6 0 3-1.6 4-1M2 11c2-2 4-2 6 0s4 2 6 0 3-1.6 4-1M2 15.5c2-2 4-2 6 0s4 2 6 0 3-1.6 4-1",
  erase:
    "M8.2 16.5 3.3 11.6a1.2 1.2 0 0 1 0-1.7l6.6-6.6a1.2 1.2 0 0 1 1.7 0l5 5a1.2 1.2 0 0 1 0 1.7l-6.5 6.5ZM6.5 6.8l6.7 6.7M8.2 16.5H17",
  undo: "M7 4 3 8l4 4M3.4 8H12a4.5 4.5 0 0 1 0 9H8",
  redo: "M13 4l4 4-4 4M16.6 8H8a4.5 4.5 0 0 0 0 9h4",
  reset: "M4 10a6 6 0 1 0 1.9-4.4M4 3v3.6h3.6",
  before: "M3 4h14v12H3ZM10 2.5v15M10 4h7v12h-7",
  save: "M10 3v9M6.2 8.5 10 12.3l3.8-3.8M3.5 14v2.5h13V14",
  close: "M5.5 5.5l9 9M14.5 5.5l-9 9",
  chevron: "M7 5l5 5-5 5",
  dome: "M10 2.5a7.5 7.5 0 1 0 0 15 7.5 7.5 0 0 0 0-15ZM10 6.5a3.5 3.5 0 1 0 0 7 3.5 3.5 0 0 0 0-7ZM10 9.9v.2",
  panorama: "M2 5c5 1.6 11 1.6 16 0v10c-5-1.6-11-1.6-16 0ZM2 12c5-.9 11-.9 16 0",
  camera: "M2.5 6h3.2l1.3-2h6l1.3 2h3.2v10h-15ZM10 8a2.9 2.9 0 1 0 0 5.8A2.9 2.9 0 0 0 10 8Z",
  play: "M6 3.8v12.4L16 10Z",
  pause: "M6.5 4v12M13.5 4v12",
  copy: "M7 7h9v10H7ZM4 13V3h9v1.5",
  split: "M3 4h14v12H3ZM10 2.5v15M6.8 8.2 5 10l1.8 1.8M13.2 8.2 15 10l-1.8 1.8",
  divider: "M7.5 6 3.5 10l4 4M12.5 6l4 4-4 4",
  full_screen: "M3 7.5V3h4.5M12.5 3H17v4.5M17 12.5V17h-4.5M7.5 17H3v-4.5",
  plus: "M10 4.5v11M4.5 10h11",
  minus: "M4.5 10h11",
  search: "M8.5 3a5.5 5.5 0 1 0 0 11 5.5 5.5 0 0 0 0-11ZM12.6 12.6 17 17",
  versions: "M6 3h8v14l-4-3.4L6 17Z",
  rename: "M12.5 4.5 15.5 7.5 7.5 15.5 4 16l.5-3.5ZM10.8 6.2l3 3",
  menu: "M3.5 5.5h13M3.5 10h13M3.5 14.5h13",
  columns: "M2.5 4.5h6.3v11H2.5ZM11.2 4.5h6.3v11h-6.3Z",
  difference: "M10 4 17 16H3Z",
  help: "M7.6 7.6a2.5 2.5 0 1 1 3.6 2.2c-.8.4-1.2.9-1.2 1.9M10 14.3v.3",
};

/** @typedef {keyof typeof PATHS} IconName */

/** @param {IconName} name */
export function icon(name) {
  return shape(
    "svg",
    { viewBox: "0 0 20 20", class: "sw-icon", "aria-hidden": "true" },
    shape("path", { d: PATHS[name] }),
  );
}
