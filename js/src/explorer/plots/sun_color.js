/** Color and illuminance of the direct sun by its elevation. */

import { cssColor } from "../color.js";
import { channel, SUN_ELEVATIONS, sample } from "../curves.js";
import { Chart, short } from "./chart.js";

const STRIP = 26; // CSS pixels

/** @param {number} klx */
const illuminance = (klx) => (klx < 1 ? `${short(1000 * klx)} lx` : `${short(klx)} klx`);

export class SunColorPlot {
  /**
   * @param {import("../../ui/theme.js").Theme} theme
   * @param {import("./types.js").Links} links
   */
  constructor(theme, links) {
    this.title = "The sun's color";
    this.help =
      "Color of the direct sun from the horizon to the zenith, each at full brightness, and its " +
      "illuminance on a surface that faces it. Drag in the plot to move the sun.";
    this.passes = ["curve_sun"];
    this.elevation = 0;
    this.chart = new Chart({
      theme,
      height: 210,
      label: "Color and illuminance of the direct sun by its elevation",
      lines: [{ label: "illuminance", color: "text", text: illuminance }],
      x: {
        label: "Sun's elevation",
        unit: "°",
        splits: [0, 2, 5, 10, 20, 40, 60, 90],
      },
      y: { label: "Illuminance", unit: "klx" },
      // Like the table: dense at the horizon, where the color changes.
      xScale: {
        range: () => [-1, 90],
        distr: 100,
        fwd: (v) => Math.sqrt(Math.max(0, v + 1)),
        bwd: (v) => v * v - 1,
      },
      yScale: {
        range: (/** @type {any} */ _u, /** @type {number} */ _low, /** @type {number} */ high) => [
          0,
          Math.max(1, high * 1.3),
        ],
      },
      over: (chart) => {
        this.drawStrip(chart);
        this.drawSun(chart);
      },
    });
    this.node = this.chart.node;
    links.moveSun(this.chart);
  }

  /** @param {import("./types.js").Context} context */
  update({ curve, sun }) {
    this.texels = curve("curve_sun");
    this.elevation = sun[1];
    this.chart.set([SUN_ELEVATIONS, channel(this.texels, 3)]);
  }

  /** @param {number} i texel */
  color(i) {
    const rgb = (this.texels ?? []).slice(4 * i, 4 * i + 3);
    // A sun that has set sends no light; its last color does not matter.
    return Math.max(...rgb, 0) > 1e-9 ? cssColor(rgb) : "#000";
  }

  /** @param {Chart} chart */
  drawStrip(chart) {
    if (!this.texels) return;
    chart.paint((context, box, ratio) => {
      for (let i = 0; i + 1 < SUN_ELEVATIONS.length; i++) {
        const left = chart.at(SUN_ELEVATIONS[i], 0)[0];
        const width = chart.at(SUN_ELEVATIONS[i + 1], 0)[0] - left + 1;
        context.fillStyle = this.color(i);
        context.fillRect(left, box.top, width, STRIP * ratio);
      }
    });
  }

  /** @param {Chart} chart */
  drawSun(chart) {
    if (!this.texels || this.elevation < -1) return;
    const klx = sample(SUN_ELEVATIONS, channel(this.texels, 3), this.elevation);
    chart.mark(this.elevation, [klx]);
  }

  summary() {
    if (!this.texels || this.elevation < -1) return "sun below −1°";
    return illuminance(sample(SUN_ELEVATIONS, channel(this.texels, 3), this.elevation));
  }
}
