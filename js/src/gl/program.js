/** Compiles a pass: its program and the uniforms that the driver reflects. */

const HEADER = "#version 300 es\n";
const PRECISION = "precision highp float; precision highp int; precision highp sampler2D;\n";

// One triangle that covers the target, without buffers, at a depth of the view volume.
const triangle = (/** @type {number} */ depth) => `
void main() {
  SetConstants();
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(corner, float(${depth}), 1.0);
}
`;

/**
 * @typedef {{ name: string, type: number, size: number, location: WebGLUniformLocation }} Uniform
 * @typedef {{ handle: WebGLProgram, uniforms: Uniform[] }} Program
 */

/**
 * Compile and link a pass.
 *
 * @param {WebGL2RenderingContext} gl
 * @param {string} name for error messages
 * @param {string} text fragment shader with its includes expanded
 * @returns {Program}
 */
export const createProgram = (gl, name, text) => beginProgram(gl, name, text)();

/**
 * Start compiling and linking a pass, and return a function that waits for it. The driver works on
 * several at once until one is queried.
 *
 * @param {WebGL2RenderingContext} gl
 * @param {string} name for error messages
 * @param {string} text fragment shader with its includes expanded
 * @param {{ constants?: string, depth?: number }} vertex code for values that are constant over all
 *   pixels, run per vertex, and the triangle's depth from -1 to 1
 * @returns {() => Program}
 */
export function beginProgram(gl, name, text, vertex = {}) {
  const { constants = "void SetConstants() {}\n", depth = 0 } = vertex;
  const handle = gl.createProgram();
  const texts = [
    { kind: gl.VERTEX_SHADER, text: HEADER + PRECISION + constants + triangle(depth) },
    { kind: gl.FRAGMENT_SHADER, text: HEADER + PRECISION + text },
  ];
  const stages = texts.map(({ kind, text: source }) => {
    const shader = gl.createShader(kind);
    if (!shader) throw new Error(`Shader "${name}" cannot be made: the WebGL context is lost.`);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(handle, shader);
    return { shader, source };
  });
  gl.linkProgram(handle);
  return () => {
    if (!gl.getProgramParameter(handle, gl.LINK_STATUS) && !gl.isContextLost()) {
      for (const { shader, source } of stages) checkStage(gl, name, shader, source);
      throw new Error(`Shader "${name}" does not link: ${gl.getProgramInfoLog(handle)}`);
    }
    for (const { shader } of stages) gl.deleteShader(shader);
    return { handle, uniforms: reflect(gl, handle) };
  };
}

/**
 * @param {WebGL2RenderingContext} gl
 * @param {string} name
 * @param {WebGLShader} shader
 * @param {string} text
 */
function checkStage(gl, name, shader, text) {
  if (gl.getShaderParameter(shader, gl.COMPILE_STATUS)) return;
  const log = gl.getShaderInfoLog(shader) ?? "";
  throw new Error(`Shader "${name}" does not compile:\n${explain(log, text)}`);
}

/**
 * Add the failing line and its neighbors to each message of a compiler log.
 *
 * @param {string} log
 * @param {string} text
 */
export function explain(log, text) {
  const lines = text.split("\n");
  return log
    .replaceAll("\0", "")
    .trim()
    .split("\n")
    .map((message) => {
      // "ERROR: 0:12: …" (ANGLE) or "0:12(3): error: …" (Mesa)
      const row = Number(/\b0:(\d+)/.exec(message)?.[1]);
      if (!row) return message;
      const excerpt = [];
      for (let i = Math.max(1, row - 2); i <= Math.min(lines.length, row + 2); i++) {
        excerpt.push(`${i === row ? ">" : " "} ${String(i).padStart(4)} | ${lines[i - 1]}`);
      }
      return `${message}\n${excerpt.join("\n")}`;
    })
    .join("\n");
}

/**
 * @param {WebGL2RenderingContext} gl
 * @param {WebGLProgram} handle
 */
function reflect(gl, handle) {
  /** @type {Uniform[]} */
  const uniforms = [];
  const count = gl.getProgramParameter(handle, gl.ACTIVE_UNIFORMS) ?? 0;
  for (let i = 0; i < count; i++) {
    const info = gl.getActiveUniform(handle, i);
    const location = info && gl.getUniformLocation(handle, info.name);
    if (!info || !location) continue;
    uniforms.push({
      name: info.name.replace(/\[0\]$/, ""),
      type: info.type,
      size: info.size,
      location,
    });
  }
  return uniforms;
}

/**
 * Set a uniform, of the type that the driver reflects, to a number or vector.
 *
 * @param {WebGL2RenderingContext} gl
 * @param {Uniform} uniform
 * @param {number | number[]} value
 */
export function setUniform(gl, uniform, value) {
  const { location } = uniform;
  const list = typeof value === "number" ? [value] : value;
  switch (uniform.type) {
    case gl.FLOAT:
      gl.uniform1fv(location, list);
      break;
    case gl.FLOAT_VEC2:
      gl.uniform2fv(location, list);
      break;
    case gl.FLOAT_VEC3:
      gl.uniform3fv(location, list);
      break;
    case gl.FLOAT_VEC4:
      gl.uniform4fv(location, list);
      break;
    case gl.FLOAT_MAT3:
      gl.uniformMatrix3fv(location, false, list);
      break;
    case gl.FLOAT_MAT4:
      gl.uniformMatrix4fv(location, false, list);
      break;
    case gl.INT:
    case gl.BOOL:
      gl.uniform1iv(location, list);
      break;
    default:
      throw new Error(`Uniform "${uniform.name}" has a type that the runner does not know.`);
  }
}
