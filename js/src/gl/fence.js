/** Checks whether the GPU has finished its work, without waiting for it. */

export class Fence {
  /** @param {import("./surface.js").Surface} surface */
  constructor(surface) {
    this.surface = surface;
    /** @type {WebGL2RenderingContext | null} */
    this.gl = null;
    /** @type {WebGLSync | null} */
    this.sync = null;
  }

  /**
   * Whether everything that the surface had drawn at the first call is finished. Call again later
   * while false; after true, the next call starts a new fence.
   */
  passed() {
    const gl = this.surface.graph?.gl;
    if (!gl || gl.isContextLost()) return true;
    if (!this.sync || this.gl !== gl) {
      this.gl = gl;
      this.sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
      gl.flush();
      return false;
    }
    if (gl.clientWaitSync(this.sync, 0, 0) === gl.TIMEOUT_EXPIRED) return false;
    gl.deleteSync(this.sync);
    this.sync = null;
    return true;
  }
}
