/** Made by build.mjs from `sunwidget/shaders/`: each graph with the shaders that it reaches. */
declare module "sunwidget:shaders/editor" {
  export const files: Record<string, string>;
  export const graph: import("./graph.js").Description;
}
declare module "sunwidget:shaders/explorer" {
  export const files: Record<string, string>;
  export const graph: import("./graph.js").Description;
}
