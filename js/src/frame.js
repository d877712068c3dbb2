/**
 * The composited frame of one editor: pictures and scene in, pixels on a canvas out.
 *
 * The graph draws to a WebGL canvas of its own, and each finished frame is copied to the
 * visible 2-D canvas. So the last frame stays in sight when the WebGL context is lost
 * (Chromium keeps 16 contexts and kills the oldest), and the next draw makes a new one.
 */

import { graph as description, files } from "sunwidget:shaders";
import { Graph } from "./gl/graph.js";
import { states } from "./gl/values.js";

/**
 * @typedef {import("./types.js").Edit} Edit
 * @typedef {import("./types.js").Parameter} Parameter
 * @typedef {import("./types.js").Scene} Scene
 * @typedef {import("./gl/texture.js").Pixels} Pixels
 */

const NO_WEBGL =
  "This browser offers no WebGL2, which the live preview needs. Turn on hardware acceleration " +
  "or use another browser; exports from Python work all the same.";

/**
 * What the host adds to every frame: encode as sRGB, dither by half a level, show all of it.
 *
 * @type {import("./gl/values.js").Values}
 */
const HOST = { output_transfer: 1, dither: 0.5, view: [0, 0, 1, 1] };

export class Frame {
  /**
   * @param {HTMLCanvasElement} canvas the visible canvas
   * @param {Parameter[]} parameters the kernel's table
   */
  constructor(canvas, parameters) {
    const context = canvas.getContext("2d", { alpha: false });
    if (!context) throw new Error("This browser offers no 2-D canvas.");
    this.canvas = canvas;
    this.context = context;
    this.parameters = parameters;
    /** @type {Map<string, Pixels>} kept, so that a lost context can be rebuilt */
    this.pictures = new Map();
    /** @type {Pick<Scene, "automatic" | "uniforms"> | null} */
    this.scene = null;
    /** @type {Graph | null} */
    this.graph = null;
    this.host = { ...HOST };
  }

  /**
   * @param {string} name scene texture: photo, layers, surface or backdrop
   * @param {Pixels} pixels
   */
  setPicture(name, pixels) {
    const previous = this.pictures.get(name);
    if (previous && previous !== pixels && "close" in previous) previous.close();
    this.pictures.set(name, pixels);
    this.graph?.setTexture(name, pixels);
  }

  /** @param {Pick<Scene, "automatic" | "uniforms">} scene */
  setScene(scene) {
    this.scene = scene;
  }

  /**
   * Draw the edit at a size in pixels. Returns false when the context was lost meanwhile: the
   * canvas then keeps its last frame, and another call draws anew.
   *
   * @param {Edit} edit
   * @param {[number, number]} size
   */
  draw(edit, size) {
    if (!this.scene) return false;
    const graph = this.liveGraph();
    const { gl } = graph;
    const surface = gl.canvas;
    if (surface.width !== size[0] || surface.height !== size[1]) {
      surface.width = size[0];
      surface.height = size[1];
    }
    graph.run({
      states: states(this.parameters, edit, this.scene.automatic),
      scene: this.scene.uniforms,
      host: this.host,
      size,
      method: String(edit.method ?? "ratio"),
    });
    if (gl.isContextLost()) {
      this.forget();
      return false;
    }
    if (this.canvas.width !== size[0] || this.canvas.height !== size[1]) {
      this.canvas.width = size[0];
      this.canvas.height = size[1];
    }
    this.context.drawImage(surface, 0, 0);
    return true;
  }

  /** The graph on a living context: the present one, or all of it made again. */
  liveGraph() {
    if (this.graph && !this.graph.gl.isContextLost()) return this.graph;
    this.forget();
    const surface = document.createElement("canvas");
    const gl = surface.getContext("webgl2", {
      alpha: false,
      antialias: false,
      depth: false,
      stencil: false,
      powerPreference: "high-performance",
    });
    if (!gl) throw new Error(NO_WEBGL);
    const graph = new Graph(gl, description, files);
    for (const [name, pixels] of this.pictures) graph.setTexture(name, pixels);
    this.graph = graph;
    return graph;
  }

  /** Drop a lost context's objects: the driver has freed them. */
  forget() {
    this.graph = null;
  }

  /** RGBA of the last frame, row 0 at the top. */
  pixels() {
    return this.context.getImageData(0, 0, this.canvas.width, this.canvas.height).data;
  }

  /** Free the context and the pictures. */
  dispose() {
    if (this.graph) {
      const { gl } = this.graph;
      this.graph.dispose();
      gl.getExtension("WEBGL_lose_context")?.loseContext();
    }
    this.forget();
    for (const picture of this.pictures.values()) if ("close" in picture) picture.close();
    this.pictures.clear();
  }
}
