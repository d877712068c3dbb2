/** Phase functions in polar form, the radius in decades. */

import { channel, decades, polar } from "../curves.js";
import { Chart } from "./chart.js";

const CIRCLE = 2 * Math.PI;

/** @typedef {import("./types.js").Context} Context */

export class PhasePlot {
  /** @param {import("../../ui/theme.js").Theme} theme */
  constructor(theme) {
    this.title = "Phase functions";
    this.help =
      "How much light one scattering sends in each direction (550 nm), seen from the side: the light " +
      "comes from the left and goes on to the right, 0°. Each ring is a factor of ten, in 1/sr. " +
      "Haze scatters light forward, which makes the white ring around the sun; molecules scatter as much " +
      "backward as forward.";
    this.passes = ["curve_phase"];
    this.followsHover = true;
    /** @type {[number, number]} decades at the center and the rim */
    this.span = [-3, 1];
    /** @type {number | null} */
    this.angle = null;
    this.aspect = 1;
    this.chart = new Chart({
      theme,
      height: 210,
      label: "Phase functions of air, aerosol and their mixture in polar form",
      free: true,
      lines: [
        { label: "air", color: "rayleigh" },
        { label: "aerosol", color: "aerosol", dash: [6, 3] },
        { label: "mixture", color: "text" },
      ],
      x: { label: "", hidden: true },
      y: { label: "", hidden: true },
      xScale: { range: () => this.range(1) },
      yScale: { range: () => this.range(0) },
      under: (chart) => this.drawRings(chart),
      over: (chart) => this.drawAngle(chart),
    });
    this.node = this.chart.node;
  }

  /** Limits that keep circles round. @param {number} horizontal */
  range(horizontal) {
    const radius = 1.06 * (this.span[1] - this.span[0]);
    const plot = this.chart.plot;
    if (!horizontal || !plot) return [-radius, radius];
    const aspect = plot.bbox.height > 0 ? plot.bbox.width / plot.bbox.height : this.aspect;
    return [-radius * aspect, radius * aspect];
  }

  /** @param {Context} context */
  update({ curve, scatteringAngle }) {
    const texels = curve("curve_phase");
    const lists = [0, 1, 2].map((c) => channel(texels, c));
    const [low, high] = decades(...lists);
    this.span = [Math.max(low, high - 5), Math.max(high, low + 2)];
    this.angle = scatteringAngle;
    this.mixture = lists[2];
    this.chart.set([
      null,
      ...lists.map((list) => {
        const { x, y } = polar(list, this.span[0]);
        return [x, y];
      }),
    ]);
  }

  /** @param {number | null} angle */
  hover(angle) {
    this.angle = angle;
    this.chart.redraw();
  }

  /** @param {Chart} chart */
  drawRings(chart) {
    chart.paint((context, _box, ratio) => {
      const [cx, cy] = chart.at(0, 0);
      const decade = chart.at(1, 0)[0] - cx;
      const count = this.span[1] - this.span[0];
      context.strokeStyle = chart.theme.line;
      context.lineWidth = ratio;
      context.fillStyle = chart.theme.quiet;
      context.font = `${10 * ratio}px system-ui, sans-serif`;
      for (let k = 1; k <= count; k++) {
        context.beginPath();
        context.arc(cx, cy, k * decade, 0, CIRCLE);
        context.stroke();
      }
      for (let degrees = 0; degrees < 360; degrees += 30) {
        const angle = (degrees * Math.PI) / 180;
        context.beginPath();
        context.moveTo(cx, cy);
        context.lineTo(
          cx + count * decade * Math.cos(angle),
          cy - count * decade * Math.sin(angle),
        );
        context.stroke();
      }
      context.textAlign = "right";
      for (let k = 1; k <= count; k++) {
        const power = this.span[0] + k;
        const text = power >= 0 ? String(10 ** power) : (10 ** power).toFixed(-power);
        context.fillText(text, cx - (k * decade - 2 * ratio) * 0.87, cy - k * decade * 0.5);
      }
      context.textAlign = "left";
      context.textBaseline = "middle";
      const rim = count * decade + 5 * ratio;
      for (const degrees of [0, 60, 90, 120, 180]) {
        const angle = (degrees * Math.PI) / 180;
        context.textAlign = degrees < 90 ? "left" : degrees > 90 ? "right" : "center";
        if (degrees === 90) continue;
        context.fillText(`${degrees}°`, cx + rim * Math.cos(angle), cy - rim * Math.sin(angle));
      }
    });
  }

  /** @param {Chart} chart */
  drawAngle(chart) {
    const angle = this.angle;
    if (angle === null || !this.mixture) return;
    chart.paint((context, _box, ratio) => {
      const [cx, cy] = chart.at(0, 0);
      const reach = (this.span[1] - this.span[0]) * (chart.at(1, 0)[0] - cx);
      const radians = (angle * Math.PI) / 180;
      context.strokeStyle = chart.theme.accent;
      context.lineWidth = 1.5 * ratio;
      context.beginPath();
      context.moveTo(cx, cy);
      context.lineTo(cx + reach * Math.cos(radians), cy - reach * Math.sin(radians));
      context.stroke();
      const value = (this.mixture ?? [])[Math.round(angle)];
      const radius = Math.max(0, Math.log10(value) - this.span[0]);
      chart.dot(context, radius * Math.cos(radians), radius * Math.sin(radians), ratio);
    });
  }

  summary() {
    return this.angle === null ? "" : `${this.angle.toFixed(0)}° from the sun`;
  }
}
