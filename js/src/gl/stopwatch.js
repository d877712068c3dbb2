/**
 * Measures a frame's time: with a GPU timer query where the browser allows it, else from the first
 * command until a fence signals that all are done.
 */

/**
 * @typedef {{ ms: number, by: "timer query" | "fence" }} Lap
 * @typedef {{ TIME_ELAPSED_EXT: number, GPU_DISJOINT_EXT: number }} TimerQueries
 */

const POLL_MS = 2; // interval between queries

export class Stopwatch {
  /** @param {(lap: Lap) => void} onLap receives each frame's time, some time after it was drawn */
  constructor(onLap) {
    this.onLap = onLap;
    /** Whether a frame is being measured; frames drawn meanwhile are not measured. */
    this.running = false;
  }

  /**
   * Run the work that draws a frame, and measure it.
   *
   * @template T
   * @param {WebGL2RenderingContext} gl
   * @param {() => T} work
   * @returns {T}
   */
  time(gl, work) {
    if (this.running) return work();
    const timer = /** @type {TimerQueries | null} */ (
      gl.getExtension("EXT_disjoint_timer_query_webgl2")
    );
    this.running = true;
    try {
      return timer ? this.byQuery(gl, timer, work) : this.byFence(gl, work);
    } catch (error) {
      this.running = false;
      throw error;
    }
  }

  /**
   * @template T
   * @param {WebGL2RenderingContext} gl
   * @param {TimerQueries} timer
   * @param {() => T} work
   */
  byQuery(gl, timer, work) {
    const query = /** @type {WebGLQuery} */ (gl.createQuery());
    gl.beginQuery(timer.TIME_ELAPSED_EXT, query);
    try {
      return work();
    } finally {
      gl.endQuery(timer.TIME_ELAPSED_EXT);
      this.await(gl, () => {
        if (!gl.getQueryParameter(query, gl.QUERY_RESULT_AVAILABLE)) return false;
        // A GPU clock change meanwhile invalidates the measurement.
        const valid = !gl.getParameter(timer.GPU_DISJOINT_EXT);
        const ms = Number(gl.getQueryParameter(query, gl.QUERY_RESULT)) / 1e6;
        gl.deleteQuery(query);
        if (valid) this.onLap({ ms, by: "timer query" });
        return true;
      });
    }
  }

  /**
   * @template T
   * @param {WebGL2RenderingContext} gl
   * @param {() => T} work
   */
  byFence(gl, work) {
    const begin = performance.now();
    const result = work();
    const fence = /** @type {WebGLSync} */ (gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0));
    gl.flush();
    this.await(gl, () => {
      if (gl.clientWaitSync(fence, 0, 0) === gl.TIMEOUT_EXPIRED) return false;
      gl.deleteSync(fence);
      this.onLap({ ms: performance.now() - begin, by: "fence" });
      return true;
    });
    return result;
  }

  /**
   * Poll until `answered` returns true. A lost context never answers.
   *
   * @param {WebGL2RenderingContext} gl
   * @param {() => boolean} answered
   */
  await(gl, answered) {
    const ask = () => {
      if (gl.isContextLost() || answered()) this.running = false;
      else setTimeout(ask, POLL_MS);
    };
    setTimeout(ask, 0);
  }
}

/**
 * Return the name of the graphics card or driver, as the browser reports it.
 *
 * @param {WebGL2RenderingContext} gl
 */
export function cardName(gl) {
  const names = gl.getExtension("WEBGL_debug_renderer_info");
  return String(gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
}
