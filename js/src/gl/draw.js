/** One draw of a program: a triangle over all of the target, or over its pixels at some depth. */

import { setUniform } from "./program.js";

/**
 * @typedef {import("./program.js").Program} Program
 * @typedef {Record<string, number | number[]>} Uniforms
 * @typedef {Record<string, import("./texture.js").Texture>} Textures
 */

/**
 * @param {WebGL2RenderingContext} gl
 * @param {Program} program
 * @param {Uniforms} values
 * @param {Textures} textures
 */
export function draw(gl, program, values, textures) {
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
 * Write to which part each pixel belongs as its depth.
 *
 * @param {WebGL2RenderingContext} gl
 * @param {Program} program
 * @param {Uniforms} values
 * @param {Textures} textures
 */
export function writeParts(gl, program, values, textures) {
  gl.enable(gl.DEPTH_TEST);
  gl.depthFunc(gl.ALWAYS);
  gl.depthMask(true);
  gl.colorMask(false, false, false, false);
  draw(gl, program, values, textures);
  gl.depthMask(false);
  gl.colorMask(true, true, true, true);
  gl.disable(gl.DEPTH_TEST);
}

/**
 * Draw each part's pixels by its program. Where the depth differs no driver runs a shader, while
 * some compute both sides of a branch.
 *
 * @param {WebGL2RenderingContext} gl
 * @param {Program[]} programs
 * @param {Uniforms} values
 * @param {Textures} textures
 */
export function drawParts(gl, programs, values, textures) {
  gl.enable(gl.DEPTH_TEST);
  gl.depthFunc(gl.EQUAL);
  for (const program of programs) draw(gl, program, values, textures);
  gl.disable(gl.DEPTH_TEST);
}
