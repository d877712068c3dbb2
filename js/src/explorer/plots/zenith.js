/** Color of the zenith from twilight into day: in the chromaticity diagram, and by elevation. */

import { cssColor, daylight, rec709OfXyz, xyzOfChromaticity } from "../color.js";
import { channel, sample, ZENITH_ELEVATIONS } from "../curves.js";
import { Chart } from "./chart.js";

const X = [0.18, 0.37];
const Y = [0.17, 0.38];
const CELLS = 40;
const DAYLIGHT = [5000, 6500, 10000];
/** Elevations named on the track, and to which side. @type {[number, number][]} */
const NAMED = [
  [-12, -1],
  [-6, 1],
  [0, -1],
];

const digits = (/** @type {number} */ v) => v.toFixed(3);

/** The track in CIE x, y. */
export class ZenithTrackPlot {
  /** @param {import("../../ui/theme.js").Theme} theme */
  constructor(theme) {
    this.title = "Zenith in CIE x, y";
    this.help =
      "Chromaticity of the zenith as the sun goes from −12° to 28°; the dot is the current sun. The dashed line is " +
      "daylight from 5000 K to 25000 K. Without ozone the blue hour would stay near it.";
    this.passes = ["curve_zenith"];
    this.elevation = 0;
    this.chart = new Chart({
      theme,
      height: 210,
      label: "Chromaticity of the zenith in the CIE x, y diagram",
      free: true,
      lines: [
        { label: "zenith, −12° to 28°", color: "text" },
        { label: "daylight", color: "quiet", dash: [4, 3] },
      ],
      x: { label: "x", splits: [0.2, 0.25, 0.3, 0.35], values: (v) => v.toFixed(2) },
      y: { label: "y", splits: [0.2, 0.25, 0.3, 0.35], values: (v) => v.toFixed(2) },
      xScale: { range: () => X },
      yScale: { range: () => Y },
      under: (chart) => this.drawColors(chart),
      over: (chart) => this.drawNow(chart),
    });
    this.node = this.chart.node;
    /** @type {HTMLCanvasElement | null | undefined} */
    this.picture = undefined;
    const curve = Array.from({ length: 41 }, (_, i) => daylight(5000 + 500 * i));
    this.daylight = [curve.map((p) => p[0]), curve.map((p) => p[1])];
  }

  /** @param {import("./types.js").Context} context */
  update({ curve, sun }) {
    const texels = curve("curve_zenith");
    this.elevation = sun[1];
    this.track = [channel(texels, 0), channel(texels, 1)];
    this.chart.set([null, this.track, this.daylight]);
  }

  /** Draw the diagram's colors as a quiet background. @param {Chart} chart */
  drawColors(chart) {
    this.picture ??= paintDiagram();
    chart.paint((context, box) => {
      context.globalAlpha = 0.55;
      context.imageSmoothingEnabled = true;
      if (this.picture) context.drawImage(this.picture, box.left, box.top, box.width, box.height);
      context.globalAlpha = 1;
    });
  }

  /** @param {Chart} chart */
  drawNow(chart) {
    const track = this.track;
    if (!track) return;
    chart.paint((context, _box, ratio) => {
      context.fillStyle = chart.theme.text;
      context.font = `${10 * ratio}px system-ui, sans-serif`;
      for (const kelvin of DAYLIGHT) {
        const [x, y] = chart.at(...daylight(kelvin));
        context.beginPath();
        context.arc(x, y, 1.8 * ratio, 0, 2 * Math.PI);
        context.fill();
        context.fillText(`${kelvin / 1000} kK`, x + 5 * ratio, y + 9 * ratio);
      }
      const at = (/** @type {number} */ degrees) => [
        sample(ZENITH_ELEVATIONS, track[0], degrees),
        sample(ZENITH_ELEVATIONS, track[1], degrees),
      ];
      for (const [degrees, side] of NAMED) {
        const [x, y] = chart.at(at(degrees)[0], at(degrees)[1]);
        context.beginPath();
        context.arc(x, y, 2 * ratio, 0, 2 * Math.PI);
        context.fill();
        context.textAlign = side < 0 ? "right" : "left";
        const name = `${degrees}°`.replace("-", "−");
        context.fillText(name, x + side * 6 * ratio, y + (side < 0 ? -3 : 10) * ratio);
      }
      const [x, y] = at(this.elevation);
      chart.dot(context, x, y, ratio);
    });
  }

  summary() {
    if (!this.track) return "";
    const [x, y] = this.track.map((list) => sample(ZENITH_ELEVATIONS, list, this.elevation));
    return `x ${digits(x)}  y ${digits(y)}`;
  }
}

function paintDiagram() {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = CELLS;
  const context = canvas.getContext("2d");
  if (!context) return null;
  for (let row = 0; row < CELLS; row++) {
    for (let column = 0; column < CELLS; column++) {
      const x = X[0] + ((column + 0.5) / CELLS) * (X[1] - X[0]);
      const y = Y[1] - ((row + 0.5) / CELLS) * (Y[1] - Y[0]);
      context.fillStyle = cssColor(rec709OfXyz(xyzOfChromaticity(x, y)));
      context.fillRect(column, row, 1, 1);
    }
  }
  return canvas;
}

/** x and y against the sun's elevation. */
export class ZenithElevationPlot {
  /**
   * @param {import("../../ui/theme.js").Theme} theme
   * @param {import("./types.js").Links} links
   */
  constructor(theme, links) {
    this.title = "Zenith through twilight";
    this.help =
      "The same by the sun's elevation: x and y dip together where the sky is bluest, the blue hour. " +
      "The strip shows the color itself. Drag in the plot to move the sun.";
    this.passes = ["curve_zenith"];
    this.elevation = 0;
    this.chart = new Chart({
      theme,
      height: 210,
      label: "Chromaticity of the zenith by the sun's elevation",
      lines: [
        { label: "x", color: "nm640", text: digits },
        { label: "y", color: "nm510", dash: [6, 3], text: digits },
      ],
      x: { label: "Sun's elevation", unit: "°", splits: [-12, -6, 0, 6, 12, 18, 24] },
      y: { label: "Chromaticity", values: (v) => v.toFixed(2) },
      xScale: { range: () => [-12, 28] },
      yScale: { range: () => [0.15, 0.45] },
      over: (chart) => {
        this.drawStrip(chart);
        this.drawNow(chart);
      },
    });
    this.node = this.chart.node;
    links.moveSun(this.chart);
  }

  /** @param {import("./types.js").Context} context */
  update({ curve, sun }) {
    const texels = curve("curve_zenith");
    this.elevation = sun[1];
    this.chart.set([ZENITH_ELEVATIONS, channel(texels, 0), channel(texels, 1)]);
  }

  /** @param {Chart} chart */
  drawStrip(chart) {
    const [elevations, x, y] = chart.data ?? [];
    if (!elevations) return;
    chart.paint((context, box, ratio) => {
      for (let i = 0; i + 1 < elevations.length; i++) {
        const left = chart.at(elevations[i], 0.3)[0];
        const width = chart.at(elevations[i + 1], 0.3)[0] - left + 1;
        context.fillStyle =
          y[i] > 0 ? cssColor(rec709OfXyz(xyzOfChromaticity(x[i], y[i]))) : "#000";
        context.fillRect(left, box.top, width, 22 * ratio);
      }
    });
  }

  /** @param {Chart} chart */
  drawNow(chart) {
    const [elevations, ...lists] = chart.data ?? [];
    if (!elevations || this.elevation > 28) return;
    chart.mark(
      this.elevation,
      lists.map((/** @type {number[]} */ list) => sample(elevations, list, this.elevation)),
    );
  }
}
