/** The programs of a graph's shaders, compiled on demand. */

import { resolveIncludes } from "./include.js";
import { beginProgram } from "./program.js";

/**
 * @typedef {import("./program.js").Program} Program
 * @typedef {{ shader: string, constants?: string, depth?: number }} Stage inputs of one program
 */

export class Programs {
  /**
   * @param {WebGL2RenderingContext} gl
   * @param {Record<string, string>} files shader texts by path
   */
  constructor(gl, files) {
    this.gl = gl;
    this.files = files;
    /** @type {Map<string, Program>} */
    this.made = new Map();
    /** @type {Map<string, () => Program>} programs being compiled */
    this.compiling = new Map();
  }

  /** Start compiling a stage if needed, without waiting. @param {Stage} stage */
  begin({ shader, constants, depth }) {
    if (this.made.has(shader) || this.compiling.has(shader)) return;
    const text = (/** @type {string} */ name) => resolveIncludes(this.files, `${name}.glsl`);
    const vertex = { constants: constants && text(constants), depth };
    this.compiling.set(shader, beginProgram(this.gl, shader, text(shader), vertex));
  }

  /** @param {Stage} stage */
  get(stage) {
    let program = this.made.get(stage.shader);
    if (!program) {
      this.begin(stage);
      program = /** @type {() => Program} */ (this.compiling.get(stage.shader))();
      this.compiling.delete(stage.shader);
      this.made.set(stage.shader, program);
    }
    return program;
  }

  /** Free all programs. */
  dispose() {
    for (const program of this.made.values()) this.gl.deleteProgram(program.handle);
    this.made.clear();
    this.compiling.clear();
  }
}
