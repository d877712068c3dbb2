/**
 * Run the frame graph on WebGL2. `docs/developer/frame-graph.md` is the contract; the kernel's twin is
 * `sunwidget/renderer/graph.py`. A runner knows nothing about skies: it compiles the passes,
 * hands them uniforms and textures, and runs again only what changed.
 */

import { createLightTexture } from "./decode.js";
import { resolveIncludes } from "./include.js";
import { beginProgram, setUniform } from "./program.js";
import { createTarget, deleteTarget, missingFeature, turn } from "./target.js";
import { createPictureTexture } from "./texture.js";
import { uniformValue } from "./values.js";

/**
 * @typedef {import("./program.js").Program} Program
 * @typedef {import("./target.js").Target} Target
 * @typedef {import("./texture.js").Texture} Texture
 * @typedef {import("./values.js").Values} Values
 * @typedef {number[] | "frame" | ["frame", number] | string} Size
 * @typedef {{
 *   name: string, shader: string, size: Size, format: "rgba32f" | "output", state: string,
 *   inputs: Record<string, string | string[]>, when?: string[], history?: boolean,
 *   constants?: string, parts?: { by: string, shaders: string[] },
 * }} Pass
 * @typedef {{ shader: string, constants?: string, depth?: number }} Stage what one draw is compiled of
 * @typedef {{ passes: Pass[], scene_uniforms: Record<string, string> }} Description
 * @typedef {{
 *   states: Record<string, Values>, scene: Values, host: Values, size: [number, number],
 *   sizes?: Record<string, [number, number]>, methods: string[],
 * }} Frame what a run needs: values by state, and who asks for it (`when`)
 */

// Scene textures whose channels are encoded sRGB; the others hold levels.
const ENCODED = new Set(["photo"]);

// What a pass with a history reads of it; no part of what makes it dirty.
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
    this.files = files;
    /** @type {Map<string, Program>} */
    this.programs = new Map();
    /** @type {Map<string, () => Program>} those under way */
    this.compiling = new Map();
    /** @type {Map<string, Target>} */
    this.targets = new Map();
    /**
     * What passes drew at another size: a drag draws smaller, and what follows it is there already.
     *
     * @type {Map<string, Target[]>}
     */
    this.spares = new Map();
    /** How many edits are drawn in turn: so many are kept of each table that has a size of its own. */
    this.turns = 1;
    /** @type {Map<string, Texture>} */
    this.textures = new Map();
    /** @type {Record<string, number>} how often each pass was drawn */
    this.runs = {};
    /** @type {(number | string)[]} what the canvas's depth was drawn from (writeParts) */
    this.partsKey = [];
    /** @type {Set<string>} passes that the present run may draw */
    this.drawn = new Set();
    this.versions = 0; // of all textures: two sizes of one pass must differ, too
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
    this.versions += 1;
    texture.version = this.versions;
    this.textures.set(name, texture);
  }

  /**
   * Run what changed of the pass `until` and all that it reads: unless it is named, the pass whose
   * format is `output`, which draws to the canvas.
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
   * Begin to compile what a run needs, and return its passes. Nobody waits yet, so a run that comes
   * later finds the programs there.
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
    for (const pass of passes) for (const stage of this.stages(pass)) this.begin(stage);
    return passes;
  }

  /**
   * `last` and the rows that it reads, each pass by way of others.
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
   * The first of an input's names that is drawn in this run or loaded.
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
    const programs = stages.map((stage) => this.program(stage));
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
      textures.history = turn(gl, pass.name, target);
      values.sample_index = target.samples;
    } else if (unchanged) {
      return;
    }

    gl.bindFramebuffer(gl.FRAMEBUFFER, target ? target.framebuffer : null);
    gl.viewport(0, 0, width, height);
    if (pass.parts && programs.length > 1) {
      this.writeParts(programs[0], key.slice(0, ends[0]), values, textures);
      this.drawParts(programs.slice(1), values, textures);
    } else {
      this.draw(programs[0], values, textures);
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
   * @param {Program} program
   * @param {Record<string, number | number[]>} values
   * @param {Record<string, Texture>} textures
   */
  draw(program, values, textures) {
    const { gl } = this;
    gl.useProgram(program.handle);
    let unit = 0;
    for (const uniform of program.uniforms) {
      const texture = textures[uniform.name];
      if (!texture) {
        setUniform(gl, uniform, values[uniform.name]);
        continue;
      }
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, texture.handle);
      gl.uniform1i(uniform.location, unit);
      unit += 1;
    }
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  /**
   * Write to which part each pixel belongs as its depth, unless it stands there already.
   *
   * @param {Program} program
   * @param {(number | string)[]} key what the depth is drawn from
   * @param {Record<string, number | number[]>} values
   * @param {Record<string, Texture>} textures
   */
  writeParts(program, key, values, textures) {
    const { gl } = this;
    if (same(this.partsKey, key)) return;
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.ALWAYS);
    gl.depthMask(true);
    gl.colorMask(false, false, false, false);
    this.draw(program, values, textures);
    gl.depthMask(false);
    gl.colorMask(true, true, true, true);
    gl.disable(gl.DEPTH_TEST);
    this.partsKey = key;
  }

  /**
   * Draw each part's pixels by its program. Where the depth differs no driver runs a shader, while
   * some compute both sides of a branch.
   *
   * @param {Program[]} programs
   * @param {Record<string, number | number[]>} values
   * @param {Record<string, Texture>} textures
   */
  drawParts(programs, values, textures) {
    const { gl } = this;
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.EQUAL);
    for (const program of programs) this.draw(program, values, textures);
    gl.disable(gl.DEPTH_TEST);
  }

  /**
   * What a pass drew last, RGBA by rows, row 0 at the top.
   *
   * @param {string} name
   */
  read(name) {
    const { gl } = this;
    const target = this.targets.get(name);
    if (!target) throw new Error(`Pass "${name}" was not drawn yet.`);
    const { width, height } = target.texture;
    const texels = new Float32Array(4 * width * height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, texels);
    return texels;
  }

  /**
   * What draws a pass: its shader alone, or what tells its parts apart and then each part's. Without
   * a depth buffer the pass' own shader draws all parts.
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

  /** Begin to compile what is not compiled yet. @param {Stage} stage */
  begin({ shader, constants, depth }) {
    if (this.programs.has(shader) || this.compiling.has(shader)) return;
    const text = (/** @type {string} */ name) => resolveIncludes(this.files, `${name}.glsl`);
    const vertex = { constants: constants && text(constants), depth };
    this.compiling.set(shader, beginProgram(this.gl, shader, text(shader), vertex));
  }

  /** @param {Stage} stage */
  program(stage) {
    let program = this.programs.get(stage.shader);
    if (!program) {
      this.begin(stage);
      program = /** @type {() => Program} */ (this.compiling.get(stage.shader))();
      this.compiling.delete(stage.shader);
      this.programs.set(stage.shader, program);
    }
    return program;
  }

  /**
   * Where a pass draws, or has drawn just this: what it drew for another size of the frame stays.
   *
   * @param {Pass} pass
   * @param {[number, number]} size
   * @param {(number | string)[]} key what the pass is drawn from
   * @param {number} frame width of the frame
   */
  target({ name, size: asked }, size, key, frame) {
    const table = this.turns > 1 && typeof asked[0] === "number";
    // The one that was used last comes first.
    const made = [this.targets.get(name), this.spares.get(name)].flatMap((t) => t ?? []);
    const fitting = made.filter(({ texture: t }) => t.width === size[0] && t.height === size[1]);
    const target =
      fitting.find((t) => t.key && same(t.key, key)) ??
      (table ? fitting[this.turns - 1] : fitting.find((t) => t.frame === frame)) ??
      createTarget(this.gl, name, ...size);
    target.frame = frame;
    this.targets.set(name, target);
    const others = made.filter((t) => t !== target);
    // Of many sizes the picture in full is kept: it is the dearest.
    if (!table) others.sort((a, b) => b.frame - a.frame);
    const kept = table ? this.turns - 1 : 1;
    this.spares.set(name, others.slice(0, kept));
    for (const other of others.slice(kept)) deleteTarget(this.gl, other);
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

  /** Free what the passes drew into. */
  deleteTargets() {
    for (const target of [...this.targets.values(), ...[...this.spares.values()].flat()]) {
      deleteTarget(this.gl, target);
    }
    this.targets.clear();
    this.spares.clear();
  }

  /** Free every GL object. */
  dispose() {
    const { gl } = this;
    this.deleteTargets();
    for (const texture of this.textures.values()) gl.deleteTexture(texture.handle);
    for (const program of this.programs.values()) gl.deleteProgram(program.handle);
    this.textures.clear();
    this.programs.clear();
    this.compiling.clear();
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

/**
 * Whether two keys of a pass are equal.
 *
 * @param {(number | string)[]} a
 * @param {(number | string)[]} b
 */
export function same(a, b) {
  // Object.is: a NaN must not draw its pass for ever.
  return a.length === b.length && a.every((value, i) => Object.is(value, b[i]));
}
