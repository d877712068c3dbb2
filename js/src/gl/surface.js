/**
 * Shows a frame graph's pixels on a canvas of the page.
 *
 * The graph draws to its own WebGL canvas, and each finished frame is copied to the visible 2-D
 * canvas. So the last frame stays visible when the WebGL context is lost or released to the page's
 * pool, and the next draw makes a new one.
 */

import { Graph } from "./graph.js";
import { forgetContext, useContext } from "./pool.js";
import { readLevels } from "./texture.js";

/**
 * @typedef {import("./graph.js").Description} Description
 * @typedef {import("./graph.js").Frame} Frame
 * @typedef {import("./texture.js").Pixels} Pixels
 */

const NO_WEBGL =
  "This browser has no WebGL2, which the live preview needs. Turn on hardware acceleration " +
  "or use another browser; exports from Python still work.";
const TAKEN_AWAY =
  "The browser took the graphics context away and offers no other, as after a graphics driver " +
  "crash. Reload the page; your edit is kept.";
const MOST_LOSSES = 3; // in a row, after which the cause is taken to be permanent

export class Surface {
  /**
   * @param {HTMLCanvasElement} canvas the visible canvas
   * @param {Description} description
   * @param {Record<string, string>} files shader texts by path
   * @param {{ alpha: boolean }} options whether the picture may be transparent
   */
  constructor(canvas, description, files, { alpha }) {
    const context = canvas.getContext("2d", { alpha });
    if (!context) throw new Error("This browser has no 2-D canvas.");
    this.canvas = canvas;
    this.context = context;
    this.description = description;
    this.files = files;
    this.alpha = alpha;
    /** @type {Map<string, Pixels>} kept, so that a lost context can be rebuilt */
    this.pictures = new Map();
    /** @type {Graph | null} */
    this.graph = null;
    /** @type {import("./stopwatch.js").Stopwatch | null} measures frames, if set */
    this.stopwatch = null;
    this.turns = 1; // number of edits drawn in turn (targets.js)
    this.worked = false; // whether there has ever been a context
    this.losses = 0; // contexts lost in a row
    this.release = () => this.releaseContext();
  }

  /**
   * @param {string} name
   * @param {Pixels} pixels
   */
  setTexture(name, pixels) {
    const previous = this.pictures.get(name);
    if (previous && previous !== pixels && "close" in previous) previous.close();
    this.pictures.set(name, pixels);
    if (!this.graph) return;
    const { gl } = this.graph;
    try {
      this.graph.setTexture(name, pixels);
    } catch (error) {
      if (!gl.isContextLost()) throw error;
    }
    if (gl.isContextLost()) this.forget(); // the next draw loads all pictures again
  }

  /**
   * Draw at the frame's size. Returns false if the context was lost: the canvas then keeps its last
   * frame, and another call draws again.
   *
   * @param {Frame} frame
   */
  show(frame) {
    const [width, height] = frame.size;
    const drawn = this.withGraph((graph) => {
      if (resize(graph.gl.canvas, width, height)) graph.partsKey = []; // its depth is gone
      const run = () => graph.run(frame);
      if (this.stopwatch) this.stopwatch.time(graph.gl, run);
      else run();
      return graph.gl.canvas;
    });
    if (!drawn) return false;
    if (!resize(this.canvas, width, height) && this.alpha) {
      this.context.clearRect(0, 0, width, height);
    }
    this.context.drawImage(drawn, 0, 0);
    return true;
  }

  /**
   * Draw one pass and what it reads, and return its texels; null if the context was lost.
   *
   * @param {Frame} frame
   * @param {string} name
   */
  read(frame, name) {
    return this.withGraph((graph) => {
      graph.run(frame, name);
      return graph.targets.read(name);
    });
  }

  /**
   * Return the levels of a byte texture, all four channels as sent; null if there is none or the
   * context was lost.
   *
   * @param {string} name
   */
  levels(name) {
    if (!this.pictures.has(name)) return null;
    return this.withGraph(({ gl, textures }) => {
      const texture = textures.get(name);
      return texture ? readLevels(gl, texture) : null;
    });
  }

  /**
   * Run work with the graph and return its result; null if the context was lost meanwhile. Errors
   * from a lost context are ignored.
   *
   * @template T
   * @param {(graph: Graph) => T} work
   * @returns {T | null}
   */
  withGraph(work) {
    const gl = this.liveContext();
    try {
      this.graph ??= this.makeGraph(gl);
      const result = work(this.graph);
      if (!gl.isContextLost()) {
        this.losses = 0;
        return result;
      }
    } catch (error) {
      if (!gl.isContextLost()) {
        if (!this.graph) {
          loseContext(gl);
          this.forget();
        }
        throw error;
      }
    }
    this.forget();
    this.losses += 1;
    if (this.losses < MOST_LOSSES) return null;
    this.losses = 0;
    throw new Error(TAKEN_AWAY);
  }

  /** Return the current context, or a new one if it was lost. */
  liveContext() {
    useContext(this.release);
    if (this.graph && !this.graph.gl.isContextLost()) return this.graph.gl;
    this.graph = null;
    const gl = document.createElement("canvas").getContext("webgl2", {
      alpha: this.alpha,
      antialias: false,
      depth: this.description.passes.some(({ parts }) => parts),
      preserveDrawingBuffer: true, // the depth stays from frame to frame
      stencil: false,
      powerPreference: "high-performance",
    });
    if (gl) {
      this.worked = true;
      return gl;
    }
    this.forget();
    throw new Error(this.worked ? TAKEN_AWAY : NO_WEBGL);
  }

  /** @param {WebGL2RenderingContext} gl */
  makeGraph(gl) {
    const graph = new Graph(gl, this.description, this.files);
    graph.targets.turns = this.turns;
    for (const [name, pixels] of this.pictures) graph.setTexture(name, pixels);
    return graph;
  }

  /** Drop a lost context's objects: the driver has freed them. */
  forget() {
    this.graph = null;
    forgetContext(this.release);
  }

  /** RGBA of the last frame, row 0 at the top. */
  pixels() {
    return this.context.getImageData(0, 0, this.canvas.width, this.canvas.height).data;
  }

  /** Free the context: the canvas keeps its last frame, and the next draw makes a new context. */
  releaseContext() {
    if (this.graph) {
      this.graph.dispose();
      loseContext(this.graph.gl);
    }
    this.forget();
  }

  /** Free the context and the pictures. */
  dispose() {
    this.releaseContext();
    for (const picture of this.pictures.values()) if ("close" in picture) picture.close();
    this.pictures.clear();
  }
}

/** Free a context now; otherwise it would live until memory runs short. @param {WebGL2RenderingContext | null} gl */
const loseContext = (gl) => gl?.getExtension("WEBGL_lose_context")?.loseContext();

/**
 * Resize a canvas, which clears it; returns whether the size changed.
 *
 * @param {HTMLCanvasElement | OffscreenCanvas} canvas
 * @param {number} width
 * @param {number} height
 */
function resize(canvas, width, height) {
  if (canvas.width === width && canvas.height === height) return false;
  canvas.width = width;
  canvas.height = height;
  return true;
}
