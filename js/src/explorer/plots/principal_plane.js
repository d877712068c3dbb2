/** Radiance along the great circle through sun and zenith, at the four wavelengths. */

import { turned } from "../../geometry/day.js";
import { element } from "../../ui/element.js";
import { channel, onPrincipalPlane, PLANE_ANGLES, planeDirection } from "../curves.js";
import { Chart, short } from "./chart.js";

const BANDS = ["nm640", "nm580", "nm510", "nm440"];
const NEAR = 8; // degrees from the plane at which a measured direction is shown on it

export class PrincipalPlanePlot {
  /**
   * @param {import("../../ui/theme.js").Theme} theme
   * @param {import("./types.js").Links} links
   */
  constructor(theme, links) {
    this.title = "Along the principal plane";
    this.help =
      "Radiance of the sky from the horizon below the sun (0°) over the zenith (90°) to the horizon " +
      "opposite (180°). Rings are measured, when a scan is shown.";
    this.passes = ["curve_principal_plane"];
    this.log = true;
    this.sun = [0, 0];
    /** @type {{ angle: number, radiance: number[] }[]} */
    this.measured = [];
    const text = (/** @type {number} */ v) => short(v);
    this.chart = new Chart({
      theme,
      height: 210,
      label: "Radiance along the principal plane at 640, 580, 510 and 440 nm",
      lines: [
        { label: "640", color: "nm640", text },
        { label: "580", color: "nm580", dash: [6, 3], text },
        { label: "510", color: "nm510", dash: [2, 3], text },
        { label: "440 nm", color: "nm440", text },
      ],
      x: { label: "Angle along the plane", unit: "°", splits: [0, 30, 60, 90, 120, 150, 180] },
      y: { label: "mW m⁻² sr⁻¹ nm⁻¹" },
      xScale: { range: () => [0, 180] },
      yScale: this.scale(),
      over: (chart) => this.drawMarks(chart),
      onHover: (angle) => links.point(angle === null ? null : planeDirection(angle, this.sun[0])),
    });
    this.toggle = element(
      "button",
      { type: "button", class: "sw-chip", "aria-pressed": "true", title: "Logarithmic scale" },
      "log",
    );
    this.toggle.addEventListener("click", (event) => {
      event.preventDefault();
      this.setLog(!this.log);
    });
    this.extra = this.toggle;
    this.node = this.chart.node;
  }

  /** @returns {import("./chart.js").Scale} */
  scale() {
    if (this.log) {
      // At most four decades: anything darker is night.
      return {
        distr: 3,
        log: 10,
        range: (/** @type {any} */ _u, /** @type {number} */ low, /** @type {number} */ high) => {
          const top = high > 0 ? 10 ** Math.ceil(Math.log10(high)) : 1;
          const bottom = low > 0 ? 10 ** Math.floor(Math.log10(low)) : top / 1e4;
          return [Math.max(bottom, top / 1e4), top];
        },
      };
    }
    return {
      range: (/** @type {any} */ _u, /** @type {number} */ _low, /** @type {number} */ high) => [
        0,
        high > 0 ? 1.05 * high : 1,
      ],
    };
  }

  /** @param {boolean} on */
  setLog(on) {
    this.log = on;
    this.toggle.setAttribute("aria-pressed", String(on));
    this.chart.options.yScale = this.scale();
    this.chart.dispose();
    if (this.chart.width) this.chart.make(this.chart.width);
  }

  /** @param {import("./types.js").Context} context */
  update({ curve, sun, measured }) {
    const texels = curve("curve_principal_plane");
    this.sun = sun;
    this.measured = [];
    for (const [i, [azimuth, elevation]] of (measured?.directions ?? []).entries()) {
      const { angle, away } = onPrincipalPlane(turned(azimuth - sun[0]), elevation);
      if (away <= NEAR && measured) {
        this.measured.push({ angle, radiance: measured.radiance[i].map((v) => 1000 * v) });
      }
    }
    const lists = BANDS.map((_, c) => channel(texels, c).map((v) => (v > 0 ? 1000 * v : null)));
    this.chart.set([PLANE_ANGLES, ...lists]);
  }

  /** @param {Chart} chart */
  drawMarks(chart) {
    const elevation = this.sun[1];
    if (elevation >= 0) chart.mark(elevation);
    chart.paint((context, _box, ratio) => {
      context.lineWidth = 1.5 * ratio;
      for (const { angle, radiance } of this.measured) {
        for (const [i, band] of BANDS.entries()) {
          const [x, y] = chart.at(angle, radiance[i]);
          context.strokeStyle = chart.theme[band];
          context.beginPath();
          context.arc(x, y, 3 * ratio, 0, 2 * Math.PI);
          context.stroke();
        }
      }
    });
  }
}
