/** A texture that a pass draws to, and the values that it was last drawn from. */

import { createFloatTexture } from "./texture.js";

/**
 * @typedef {{
 *   texture: import("./texture.js").Texture,
 *   framebuffer: WebGLFramebuffer,
 *   key: (number | string)[] | null,
 *   samples: number,
 *   frame: number,
 *   previous: Target | null,
 * }} Target `samples`: number of draws accumulated by a pass with a history, in turn with `previous`;
 *   `frame`: width of the frame that it was drawn for
 */

/** Return why a picture cannot be drawn here, or null.
 *
 * @param {WebGL2RenderingContext} gl
 * @returns {string | null}
 */
export function missingFeature(gl) {
  if (gl.getExtension("EXT_color_buffer_float")) return null;
  return (
    "This device cannot draw to floating-point textures (EXT_color_buffer_float), which the " +
    "sky needs. Use another browser or a computer with a graphics driver; exports from Python " +
    "still work."
  );
}

/**
 * Sides of the largest target that each context has accepted. Checking waits for all pending
 * drawing, so a smaller target, as for a drag or a thumbnail, is not checked.
 *
 * @type {WeakMap<WebGL2RenderingContext, [number, number]>}
 */
const accepted = new WeakMap();

/**
 * @param {WebGL2RenderingContext} gl
 * @param {string} pass for error messages
 * @param {number} width
 * @param {number} height
 * @returns {Target}
 */
export function createTarget(gl, pass, width, height) {
  const texture = createFloatTexture(gl, width, height);
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture.handle, 0);
  const [widest, highest] = accepted.get(gl) ?? [0, 0];
  if (width > widest || height > highest) {
    const status = gl.checkFramebufferStatus(gl.FRAMEBUFFER);
    if (status !== gl.FRAMEBUFFER_COMPLETE && !gl.isContextLost()) {
      const size = `${width}×${height}`;
      throw new Error(`The target of pass "${pass}" (${size}) is incomplete (${status}).`);
    }
    accepted.set(gl, [Math.max(widest, width), Math.max(highest, height)]);
  }
  return { texture, framebuffer, key: null, samples: 0, frame: 0, previous: null };
}

/**
 * Swap a target's current and previous textures, and return the one to read.
 *
 * @param {WebGL2RenderingContext} gl
 * @param {string} pass for error messages
 * @param {Target} target
 */
export function swapHistory(gl, pass, target) {
  const { width, height, version } = target.texture;
  target.previous ??= createTarget(gl, pass, width, height);
  const { texture, framebuffer, previous } = target;
  target.texture = previous.texture;
  target.framebuffer = previous.framebuffer;
  target.texture.version = version;
  previous.texture = texture;
  previous.framebuffer = framebuffer;
  return texture;
}

/**
 * @param {WebGL2RenderingContext} gl
 * @param {Target} target
 */
export function deleteTarget(gl, target) {
  gl.deleteFramebuffer(target.framebuffer);
  gl.deleteTexture(target.texture.handle);
  if (target.previous) deleteTarget(gl, target.previous);
}
