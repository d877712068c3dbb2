/**
 * Runs the frame graph on WebGL2. `docs/developer/frame-graph.md` is the contract; the kernel's twin
 * is `sunwidget/renderer/graph.py`. A runner knows nothing about skies: it compiles the passes,
 * passes them uniforms and textures, and reruns only what changed.
 */

import { createLightTexture } from "./decode.js";
import { draw, drawParts, writeParts } from "./draw.js";
import { Programs } from "./programs.js";
import { missingFeature, swapHistory } from "./target.js";
import { same, Targets } from "./targets.js";
import { createPictureTexture } from "./texture.js";
import { uniformValue } from "./values.js";

/**
 * @typedef {import("./programs.js").Stage} Stage
 * @typedef {import("./texture.js").Texture} Texture
 * @typedef {import("./values.js").Values} Values
 * @typedef {number[] | "frame" | ["frame", number] | string} Size
 * @typedef {{
 *   name: string, shader: string, size: Size, format: "rgba32f" | "output", state: string,
 *   inputs: Record<string, string | string[]>, when?: string[], history?: boolean,
 *   constants?: string, parts?: { by: string, shaders: string[] },
 * }} Pass
 * @typedef {{ passes: Pass[], scene_uniforms: Record<string, string> }} Description
 * @typedef {{
 *   states: Record<string, Values>, scene: Values, host: Values, size: [number, number],
 *   sizes?: Record<string, [number, number]>, methods: string[],
 * }} Frame inputs of a run: values by state, and the methods that select passes (`when`)
 */

// Scene textures whose channels are encoded sRGB; the others hold levels.
const ENCODED = new Set(["photo"]);

// Inputs that a pass reads from its history; they do not make it dirty.
const HISTORY = new Set(["history", "sample_index"]);

export class Graph {
  /**
   * @param {WebGL2RenderingContext} gl
   * @param {Description} description the passes: graph.json or explorer.json
   * @param {Record<string, string>} files shader texts by path
   */
  constructor(gl, description, files) {
    const missing = missingFeature(gl);
    if (missing) throw new Error(missing);
    this.gl = gl;
    this.description = description;
    this.programs = new Programs(gl, files);
    this.targets = new Targets(gl);
    /** @type {Map<string, Texture>} */
    this.textures = new Map();
    /** @type {Record<string, number>} how often each pass was drawn */
    this.runs = {};
    /** @type {(number | string)[]} what the canvas's depth was drawn from (draw.js) */
    this.partsKey = [];
    /** @type {Set<string>} passes that the current run may draw */
    this.drawn = new Set();
    this.versions = 0; // of all textures: two sizes of one pass must also differ
    // What stands in for a pass that is not drawn.
    this.setTexture("nothing", { data: new Uint8Array(4), width: 1, height: 1 });
  }

  /**
   * Upload a scene texture; passes that read it are redrawn.
   *
   * @param {string} name
   * @param {import("./texture.js").Pixels} pixels
   */
  setTexture(name, pixels) {
    const create = ENCODED.has(name) ? createLightTexture : createPictureTexture;
    const texture = create(this.gl, pixels);
    const previous = this.textures.get(name);
    if (previous) this.gl.deleteTexture(previous.handle);
    this.versions += 1;
    texture.version = this.versions;
    this.textures.set(name, texture);
  }

  /**
   * Run what changed in the pass `until` and everything that it reads. By default `until` is the
   * pass with format `output`, which draws to the canvas.
   *
   * @param {Frame} frame
   * @param {string} [until]
   */
  run(frame, until) {
    const [width, height] = frame.size;
    const host = {
      ...frame.host,
      frame_size: [width, height],
      tile_origin: [0, 0],
      picture_strip: [0, 0, 0, 0],
    };
    for (const pass of this.prepare(frame.methods, until)) this.runPass(pass, frame, host);
  }

  /**
   * Start compiling what a run needs, without waiting, and return its passes.
   *
   * @param {string[]} methods
   * @param {string} [until]
   */
  prepare(methods, until) {
    const rows = this.description.passes.filter(
      ({ when }) => !when || when.some((method) => methods.includes(method)),
    );
    const last = rows.find((row) => (until ? row.name === until : row.format === "output"));
    if (!last) {
      throw new Error(`The frame graph has no pass "${until}" for ${methods.join(" and ")}.`);
    }
    const passes = this.ancestors(rows, last);
    for (const pass of passes) for (const stage of this.stages(pass)) this.programs.begin(stage);
    return passes;
  }

  /**
   * Return `last` and the rows that it reads, directly or through other passes.
   *
   * @param {Pass[]} rows
   * @param {Pass} last
   */
  ancestors(rows, last) {
    this.drawn = new Set(rows.map((row) => row.name));
    const wanted = new Set([last.name]);
    for (const row of [...rows].reverse()) {
      if (!wanted.has(row.name)) continue;
      for (const names of Object.values(row.inputs)) wanted.add(this.source(names));
    }
    return rows.filter((row) => wanted.has(row.name));
  }

  /**
   * Return the first of an input's names that is drawn in this run or loaded.
   *
   * @param {string | string[]} names
   */
  source(names) {
    if (typeof names === "string") return names;
    const here = (/** @type {string} */ name) => this.drawn.has(name) || this.textures.has(name);
    return names.find(here) ?? names[names.length - 1];
  }

  /**
   * @param {Pass} pass
   * @param {Frame} frame
   * @param {Values} host
   */
  runPass(pass, frame, host) {
    const { gl } = this;
    const output = pass.format === "output";
    const [width, height] = passSize(pass.size, frame.size, frame.sizes);
    const stages = this.stages(pass);
    const programs = stages.map((stage) => this.programs.get(stage));
    const own = { ...host, pass_size: [width, height], canvas_flip: output ? 1 : 0 };

    /** @type {(number | string)[]} */
    const key = [width, height];
    const ends = []; // of each program's values in the key
    /** @type {Record<string, number | number[]>} */
    const values = {};
    /** @type {Record<string, Texture>} */
    const textures = {};
    for (const { uniforms } of programs) {
      for (const { name } of uniforms) {
        const input = pass.inputs[name];
        if (input !== undefined) {
          const source = this.source(input);
          textures[name] = this.input(pass, source);
          key.push(source, textures[name].version);
        } else if (!HISTORY.has(name)) {
          const value = uniformValue(pass.shader, name, frame.states[pass.state], frame.scene, own);
          values[name] = value;
          key.push(...(typeof value === "number" ? [value] : value));
        }
      }
      ends.push(key.length);
    }

    const target = output ? null : this.target(pass, [width, height], key, frame.size[0]);
    const unchanged = target?.key && same(target.key, key);
    if (target && pass.history) {
      if (!unchanged) target.samples = 0;
      textures.history = swapHistory(gl, pass.name, target);
      values.sample_index = target.samples;
    } else if (unchanged) {
      return;
    }

    gl.bindFramebuffer(gl.FRAMEBUFFER, target ? target.framebuffer : null);
    gl.viewport(0, 0, width, height);
    if (pass.parts && programs.length > 1) {
      const read = key.slice(0, ends[0]);
      if (!same(this.partsKey, read)) writeParts(gl, programs[0], values, textures);
      this.partsKey = read;
      drawParts(gl, programs.slice(1), values, textures);
    } else {
      draw(gl, programs[0], values, textures);
    }
    if (target) {
      target.key = key;
      target.samples += 1;
      this.versions += 1;
      target.texture.version = this.versions;
    }
    this.runs[pass.name] = (this.runs[pass.name] ?? 0) + 1;
  }

  /**
   * Return a pass's stages: its shader alone, or the shader that separates its parts and then each
   * part's. Without a depth buffer the pass's own shader draws all parts.
   *
   * @param {Pass} pass
   * @returns {Stage[]}
   */
  stages({ shader, constants, parts, format }) {
    if (!parts || format !== "output" || !this.gl.getContextAttributes()?.depth) {
      return [{ shader, constants }];
    }
    const drawn = [...parts.shaders, shader];
    return [
      { shader: parts.by },
      ...drawn.map((name, part) => ({ shader: name, constants, depth: 0.5 * (part + 1) - 1 })),
    ];
  }

  /**
   * Return the target that a pass draws to, or the one that already holds this result.
   *
   * @param {Pass} pass
   * @param {[number, number]} size
   * @param {(number | string)[]} key what the pass is drawn from
   * @param {number} frame width of the frame
   */
  target(pass, size, key, frame) {
    return this.targets.take(pass, size, key, frame);
  }

  /**
   * @param {Pass} pass
   * @param {string} name
   * @returns {Texture}
   */
  input(pass, name) {
    const texture = this.targets.latest.get(name)?.texture ?? this.textures.get(name);
    if (!texture) {
      throw new Error(`Pass "${pass.name}" reads "${name}", which is neither drawn nor loaded.`);
    }
    return texture;
  }

  /** Free every GL object. */
  dispose() {
    const { gl } = this;
    this.targets.dispose();
    this.programs.dispose();
    for (const texture of this.textures.values()) gl.deleteTexture(texture.handle);
    this.textures.clear();
  }
}

/**
 * @param {Size} size
 * @param {[number, number]} frame
 * @param {Record<string, [number, number]>} sizes by name
 * @returns {[number, number]}
 */
export function passSize(size, frame, sizes = {}) {
  if (size === "frame") return frame;
  if (typeof size === "string") return sizes[size];
  if (size[0] === "frame") {
    const share = Number(size[1]);
    return [Math.ceil(frame[0] / share), Math.ceil(frame[1] / share)];
  }
  return [Number(size[0]), Number(size[1])];
}
