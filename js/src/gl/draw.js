/** Draws a program: a triangle over the whole target, or over its pixels at one depth. */

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
 * Write each pixel's part as its depth.
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
 * Draw each part's pixels with its program. The depth test skips other pixels on every driver,
 * while some drivers compute both sides of a branch.
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
