/**
 * Run the frame graph on WebGL2. `docs/frame-graph.md` is the contract; the kernel's twin is
 * `sunwidget/renderer/graph.py`. A runner knows nothing about skies: it compiles the passes,
 * hands them uniforms and textures, and runs again only what changed.
 */

import { createLightTexture } from "./decode.js";
import { resolveIncludes } from "./include.js";
import { createProgram, setUniform } from "./program.js";
import { createTarget, deleteTarget, missingFeature } from "./target.js";
import { createPictureTexture } from "./texture.js";
import { uniformValue } from "./values.js";

/**
 * @typedef {import("./program.js").Program} Program
 * @typedef {import("./target.js").Target} Target
 * @typedef {import("./texture.js").Texture} Texture
 * @typedef {import("./values.js").Values} Values
 * @typedef {number[] | "frame" | ["frame", number]} Size
 * @typedef {{
 *   name: string, shader: string, size: Size, format: "rgba32f" | "output",
 *   state: "source" | "edit", inputs: Record<string, string>, when?: string[],
 * }} Pass
 * @typedef {{ passes: Pass[], scene_uniforms: Record<string, string> }} Description
 * @typedef {{
 *   states: { source: Values, edit: Values }, scene: Values, host: Values,
 *   size: [number, number], method: string,
 * }} Frame
 */

// Scene textures whose channels are encoded sRGB; the others hold levels.
const ENCODED = new Set(["photo"]);

export class Graph {
  /**
   * @param {WebGL2RenderingContext} gl
   * @param {Description} description graph.json
   * @param {Record<string, string>} files shader texts by path
   */
  constructor(gl, description, files) {
    const missing = missingFeature(gl);
    if (missing) throw new Error(missing);
    this.gl = gl;
    this.description = description;
    this.files = files;
    /** @type {Map<string, Program>} */
    this.programs = new Map();
    /** @type {Map<string, Target>} */
    this.targets = new Map();
    /** @type {Map<string, Texture>} */
    this.textures = new Map();
    /** @type {Record<string, number>} how often each pass was drawn */
    this.runs = {};
    this.uploads = 0;
  }

  /**
   * Upload a scene texture; whatever reads it is drawn again.
   *
   * @param {string} name
   * @param {import("./texture.js").Pixels} pixels
   */
  setTexture(name, pixels) {
    const create = ENCODED.has(name) ? createLightTexture : createPictureTexture;
    const texture = create(this.gl, pixels);
    const previous = this.textures.get(name);
    if (previous) this.gl.deleteTexture(previous.handle);
    this.uploads += 1;
    texture.version = this.uploads;
    this.textures.set(name, texture);
  }

  /**
   * Run what changed. The pass whose format is `output` draws to the canvas.
   *
   * @param {Frame} frame
   */
  run(frame) {
    const [width, height] = frame.size;
    const host = {
      ...frame.host,
      frame_size: [width, height],
      tile_origin: [0, 0],
    };
    for (const pass of this.description.passes) {
      if (pass.when && !pass.when.includes(frame.method)) continue;
      this.runPass(pass, frame, host);
    }
  }

  /**
   * @param {Pass} pass
   * @param {Frame} frame
   * @param {Values} host
   */
  runPass(pass, frame, host) {
    const { gl } = this;
    const output = pass.format === "output";
    const [width, height] = passSize(pass.size, frame.size);
    const program = this.program(pass.shader);
    const own = { ...host, pass_size: [width, height], canvas_flip: output ? 1 : 0 };

    /** @type {(number | string)[]} */
    const key = [width, height];
    /** @type {(number | number[])[]} */
    const values = [];
    for (const uniform of program.uniforms) {
      const input = pass.inputs[uniform.name];
      if (input !== undefined) {
        key.push(input, this.input(pass, input).version);
        values.push(0);
      } else {
        const state = frame.states[pass.state];
        const value = uniformValue(pass.shader, uniform.name, state, frame.scene, own);
        values.push(value);
        key.push(...(typeof value === "number" ? [value] : value));
      }
    }

    const target = output ? null : this.target(pass.name, width, height);
    if (target?.key && same(target.key, key)) return;

    gl.useProgram(program.handle);
    let unit = 0;
    program.uniforms.forEach((uniform, i) => {
      const input = pass.inputs[uniform.name];
      if (input === undefined) {
        setUniform(gl, uniform, values[i]);
        return;
      }
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, this.input(pass, input).handle);
      gl.uniform1i(uniform.location, unit);
      unit += 1;
    });
    gl.bindFramebuffer(gl.FRAMEBUFFER, target ? target.framebuffer : null);
    gl.viewport(0, 0, width, height);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    if (target) {
      target.key = key;
      target.texture.version += 1;
    }
    this.runs[pass.name] = (this.runs[pass.name] ?? 0) + 1;
  }

  /** @param {string} shader */
  program(shader) {
    let program = this.programs.get(shader);
    if (!program) {
      program = createProgram(this.gl, shader, resolveIncludes(this.files, `${shader}.glsl`));
      this.programs.set(shader, program);
    }
    return program;
  }

  /**
   * @param {string} name
   * @param {number} width
   * @param {number} height
   */
  target(name, width, height) {
    const previous = this.targets.get(name);
    if (previous?.texture.width === width && previous.texture.height === height) return previous;
    const target = createTarget(this.gl, name, width, height);
    if (previous) {
      target.texture.version = previous.texture.version;
      deleteTarget(this.gl, previous);
    }
    this.targets.set(name, target);
    return target;
  }

  /**
   * @param {Pass} pass
   * @param {string} name
   * @returns {Texture}
   */
  input(pass, name) {
    const texture = this.targets.get(name)?.texture ?? this.textures.get(name);
    if (!texture) {
      throw new Error(`Pass "${pass.name}" reads "${name}", which is neither drawn nor loaded.`);
    }
    return texture;
  }

  /** Free every GL object. */
  dispose() {
    const { gl } = this;
    for (const target of this.targets.values()) deleteTarget(gl, target);
    for (const texture of this.textures.values()) gl.deleteTexture(texture.handle);
    for (const program of this.programs.values()) gl.deleteProgram(program.handle);
    this.targets.clear();
    this.textures.clear();
    this.programs.clear();
  }
}

/**
 * @param {Size} size
 * @param {[number, number]} frame
 * @returns {[number, number]}
 */
export function passSize(size, frame) {
  if (size === "frame") return frame;
  if (size[0] === "frame") {
    const share = Number(size[1]);
    return [Math.ceil(frame[0] / share), Math.ceil(frame[1] / share)];
  }
  return [Number(size[0]), Number(size[1])];
}

/**
 * @param {(number | string)[]} a
 * @param {(number | string)[]} b
 */
function same(a, b) {
  // Object.is: a NaN must not draw its pass for ever.
  return a.length === b.length && a.every((value, i) => Object.is(value, b[i]));
}
