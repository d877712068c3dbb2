/** Made by build.mjs from `sunwidget/shaders/`. */
declare module "sunwidget:shaders" {
  export const files: Record<string, string>;
  export const graph: import("./gl/graph.js").Description;
}
