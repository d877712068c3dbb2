/** Transmittance of direct sunlight by wavelength, in total and by absorber. */

import { horizonElevation } from "../../geometry/day.js";
import { degrees } from "../../ui/angle_text.js";
import { wavelengthColor } from "../color.js";
import { channel, WAVELENGTHS } from "../curves.js";
import { Chart } from "./chart.js";

const STRIP = 12; // CSS pixels
const SUN_RADIUS = 0.27; // degrees

const percent = (/** @type {number} */ share) => `${(100 * share).toFixed(0)} %`;

export class TransmittancePlot {
  /** @param {import("../../ui/theme.js").Theme} theme */
  constructor(theme) {
    this.title = "Sunlight that arrives";
    this.help =
      "Share of the direct sunlight that is left at the camera, by wavelength, and what molecules, " +
      "aerosol and ozone alone would leave. A low sun shines through far more air, so blue goes first.";
    this.passes = ["curve_transmittance"];
    this.elevation = 0;
    this.horizon = 0;
    this.chart = new Chart({
      theme,
      height: 210,
      label: "Transmittance of the direct sunlight by wavelength",
      lines: [
        { label: "all", color: "text", text: percent },
        { label: "air", color: "rayleigh", text: percent },
        { label: "aerosol", color: "aerosol", dash: [6, 3], text: percent },
        { label: "ozone", color: "ozone", dash: [2, 3], text: percent },
      ],
      x: { label: "Wavelength", unit: "nm", splits: [400, 500, 600, 700] },
      y: {
        label: "Transmittance",
        unit: "%",
        splits: [0, 0.25, 0.5, 0.75, 1],
        values: (v) => (100 * v).toFixed(0),
      },
      xScale: { range: () => [380, 780] },
      yScale: { range: () => [0, 1.02] },
      under: (chart) => this.drawSpectrum(chart),
    });
    this.node = this.chart.node;
  }

  /** @param {import("./types.js").Context} context */
  update({ curve, sun, altitude }) {
    this.elevation = sun[1];
    this.horizon = horizonElevation(altitude) - SUN_RADIUS;
    const texels = curve("curve_transmittance");
    this.chart.set([WAVELENGTHS, ...[0, 1, 2, 3].map((c) => channel(texels, c))]);
  }

  /** Draw the wavelengths' colors: faint below the total curve, plain in a strip. @param {Chart} chart */
  drawSpectrum(chart) {
    const [x, all] = chart.data ?? [];
    if (!x) return;
    chart.paint((context, box, ratio) => {
      const bottom = box.top + box.height;
      const last = x.length - 1;
      const [left, right] = [chart.at(x[0], 0)[0], chart.at(x[last], 0)[0]];
      const spectrum = context.createLinearGradient(left, 0, right, 0);
      for (const [i, nm] of x.entries()) spectrum.addColorStop(i / last, wavelengthColor(nm));
      context.fillStyle = spectrum;
      context.beginPath();
      context.moveTo(left, bottom);
      for (const [i, nm] of x.entries()) context.lineTo(...chart.at(nm, all[i]));
      context.lineTo(right, bottom);
      context.globalAlpha = 0.3;
      context.fill();
      context.globalAlpha = 1;
      context.fillRect(left, bottom - STRIP * ratio, right - left, STRIP * ratio);
    });
  }

  summary() {
    return this.elevation < this.horizon ? "the sun is down" : `sun at ${degrees(this.elevation)}`;
  }
}
