/**
 * Converts sRGB code values to linear light with a table of 256 floats.
 *
 * The GPU could decode an SRGB8_ALPHA8 texture itself, but drivers approximate: Mesa's software
 * rasterizer errs by enough to flip a threshold against the kernel, which uses the same table.
 */

import { createProgram } from "./program.js";
import { LIGHT } from "./srgb.js";
import { createTarget } from "./target.js";
import { createFloatTexture, createPictureTexture } from "./texture.js";

const DECODE = `
uniform sampler2D codes;
uniform sampler2D table;
out vec4 result;
float Decode(float code) { return texelFetch(table, ivec2(int(code * 255.0 + 0.5), 0), 0).r; }
void main() {
  vec3 code = texelFetch(codes, ivec2(gl_FragCoord.xy), 0).rgb;
  result = vec4(Decode(code.r), Decode(code.g), Decode(code.b), 1.0);
}
`;

/**
 * Upload an sRGB picture as linear light.
 *
 * @param {WebGL2RenderingContext} gl
 * @param {import("./texture.js").Pixels} pixels
 * @returns {import("./texture.js").Texture}
 */
export function createLightTexture(gl, pixels) {
  const codes = createPictureTexture(gl, pixels);
  const table = createFloatTexture(gl, 256, 1);
  const texels = new Float32Array(4 * 256);
  LIGHT.forEach((light, i) => {
    texels[4 * i] = light;
  });
  gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, 256, 1, gl.RGBA, gl.FLOAT, texels);
  const program = createProgram(gl, "decode", DECODE);
  const target = createTarget(gl, "decode", pixels.width, pixels.height);
  const inputs = { codes, table };
  gl.useProgram(program.handle);
  Object.entries(inputs).forEach(([name, texture], unit) => {
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, texture.handle);
    const uniform = program.uniforms.find((u) => u.name === name);
    if (uniform) gl.uniform1i(uniform.location, unit);
  });
  gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
  gl.viewport(0, 0, pixels.width, pixels.height);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
  const { texture } = target;
  gl.deleteFramebuffer(target.framebuffer);
  gl.deleteTexture(codes.handle);
  gl.deleteTexture(table.handle);
  gl.deleteProgram(program.handle);
  return texture;
}
