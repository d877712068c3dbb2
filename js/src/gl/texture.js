/** Textures without filtering: every pass reads them with texelFetch. */

/**
 * @typedef {{ handle: WebGLTexture, width: number, height: number, version: number }} Texture
 * @typedef {{ data: Uint8Array, width: number, height: number }} Levels RGBA, row 0 at the top
 * @typedef {ImageBitmap | { width: number, height: number, data: ArrayBufferView }} Pixels
 */

/** @param {WebGL2RenderingContext} gl */
function createHandle(gl) {
  const handle = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, handle);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  return handle;
}

/**
 * Upload a picture, row 0 at the top.
 *
 * @param {WebGL2RenderingContext} gl
 * @param {Pixels} pixels decoded picture of four 8-bit channels, or a table of four floats per texel
 * @returns {Texture}
 */
export function createPictureTexture(gl, pixels) {
  const { width, height } = pixels;
  const limit = gl.getParameter(gl.MAX_TEXTURE_SIZE) ?? 2048;
  if (Math.max(width, height) > limit) {
    throw new Error(
      `A picture of ${width}×${height} exceeds this browser's limit of ${limit} pixels per side.`,
    );
  }
  const handle = createHandle(gl);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  const [target, type] = [gl.TEXTURE_2D, gl.UNSIGNED_BYTE];
  if ("data" in pixels && pixels.data instanceof Float32Array) {
    gl.texImage2D(target, 0, gl.RGBA32F, width, height, 0, gl.RGBA, gl.FLOAT, pixels.data);
  } else if ("data" in pixels) {
    gl.texImage2D(target, 0, gl.RGBA8, width, height, 0, gl.RGBA, type, pixels.data);
  } else {
    gl.texImage2D(target, 0, gl.RGBA8, gl.RGBA, type, pixels);
  }
  return { handle, width, height, version: 0 };
}

/**
 * Read back a byte texture. A 2-D canvas cannot: it multiplies colors by alpha.
 *
 * @param {WebGL2RenderingContext} gl
 * @param {Texture} texture
 * @returns {Levels}
 */
export function readLevels(gl, { handle, width, height }) {
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, handle, 0);
  const data = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, data);
  gl.deleteFramebuffer(framebuffer);
  return { data, width, height };
}

/**
 * @param {WebGL2RenderingContext} gl
 * @param {number} width
 * @param {number} height
 * @returns {Texture}
 */
export function createFloatTexture(gl, width, height) {
  const handle = createHandle(gl);
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, width, height);
  return { handle, width, height, version: 0 };
}

/**
 * Decode PNG or JPEG bytes exactly: no premultiplied alpha, no color conversion.
 *
 * @param {ArrayBufferView | ArrayBuffer} bytes
 * @returns {Promise<ImageBitmap>}
 */
export function decodePicture(bytes) {
  const blob = new Blob([/** @type {BlobPart} */ (bytes)]);
  return createImageBitmap(blob, { premultiplyAlpha: "none", colorSpaceConversion: "none" });
}
