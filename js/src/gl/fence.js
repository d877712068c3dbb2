/** Whether the graphics card has done what it was told, asked without waiting for it. */

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
   * Whether all that the surface had drawn when this was first asked is done. Ask again later
   * while it is not; after a yes, the next question is about what was drawn since.
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
