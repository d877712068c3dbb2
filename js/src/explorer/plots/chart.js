/** One plot: uPlot in the widget's style, with an HTML legend that also shows values. */

import uPlot from "uplot";
import { element } from "../../ui/element.js";

/**
 * @typedef {import("../../ui/theme.js").Theme} Theme
 * @typedef {{ label: string, color: string, dash?: number[], text?: (value: number) => string }} Line
 *   `color` is a name of the theme
 * @typedef {{ time?: boolean, range?: any, distr?: 1 | 3 | 100, fwd?: (v: number) => number,
 *   bwd?: (v: number) => number, log?: 10 }} Scale
 * @typedef {{ label: string, unit?: string, splits?: number[], values?: (v: number) => string,
 *   hidden?: boolean }} Axis
 */

const FONT = '11px system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';

/** @param {number} value three digits, a proper minus */
export const short = (value) =>
  Number.isFinite(value) ? String(Number(value.toPrecision(3))).replace("-", "−") : "–";

export class Chart {
  /**
   * @param {{
   *   theme: Theme, height: number, lines: Line[], x: Axis, y: Axis, xScale?: Scale, yScale?: Scale,
   *   free?: boolean, under?: (chart: Chart) => void, over?: (chart: Chart) => void,
   *   onHover?: (x: number | null) => void, label: string,
   * }} options `free`: every line has its own abscissae, in any order; `under` and `over` draw on
   *   the canvas before and after the lines
   */
  constructor(options) {
    this.options = options;
    this.theme = options.theme;
    this.target = element("div", { class: "sw-chart", role: "img", "aria-label": options.label });
    this.legend = element("div", { class: "sw-chart-legend" });
    this.node = element("div", {}, this.target, this.legend);
    /** @type {uPlot | null} */
    this.plot = null;
    /** @type {any} */
    this.data = null;
    this.values = options.lines.map((line) => this.entry(line));
  }

  /** @param {Line} line */
  entry(line) {
    const mark = element("span", { class: "sw-chart-mark" });
    mark.style.borderTop = `2px ${line.dash ? "dashed" : "solid"} var(--sw-${line.color})`;
    const value = element("span", { class: "sw-chart-value" });
    const name = element("span", {}, mark, line.label);
    this.legend.append(element("span", { class: "sw-chart-line" }, name, value));
    return value;
  }

  /** @param {number} width CSS pixels */
  resize(width) {
    if (width < 40) return;
    if (this.plot) {
      if (this.plot.width !== width) this.plot.setSize({ width, height: this.options.height });
    } else if (this.data) this.make(width);
    this.width = width;
  }

  /** @param {any} data as uPlot takes it: aligned, or [null, [x, y], …] when free */
  set(data) {
    this.data = data;
    if (this.plot) this.plot.setData(data);
    else if (this.width) this.make(this.width);
    this.showValues();
  }

  /** Redraw with new colors or marks. */
  redraw() {
    this.plot?.redraw(true);
  }

  /** @param {number} width */
  make(width) {
    const { lines, x, y, xScale = {}, yScale = {}, free = false, height } = this.options;
    const { theme } = this;
    const axis = (/** @type {Axis} */ a, /** @type {number} */ side) => ({
      scale: side === 2 ? "x" : "y",
      side,
      show: !a.hidden,
      label: a.unit ? `${a.label} (${a.unit})` : a.label,
      labelSize: 16,
      labelGap: 0,
      labelFont: FONT,
      font: FONT,
      size: side === 2 ? 24 : 38,
      gap: 3,
      space: side === 2 ? 38 : 26,
      stroke: () => theme.quiet,
      grid: { stroke: () => theme.line, width: 1 },
      ticks: { show: false },
      // uPlot would thin out the labels of any nonlinear scale as on a logarithmic one.
      ...(a.splits
        ? {
            splits: () => a.splits,
            filter: (/** @type {any} */ _u, /** @type {number[]} */ v) => v,
          }
        : {}),
      values: (/** @type {any} */ _u, /** @type {number[]} */ splits) =>
        splits.map((v) => (v === null ? "" : (a.values ?? short)(v))),
    });
    const series = lines.map((line) => ({
      label: line.label,
      stroke: () => theme[line.color],
      width: 1.8,
      dash: line.dash,
      points: { show: false },
      ...(free
        ? {
            facets: [
              { scale: "x", auto: false },
              { scale: "y", auto: false },
            ],
            paths: freePath,
          }
        : { scale: "y" }),
    }));
    /** @type {any} */
    const options = {
      mode: free ? 2 : 1,
      width,
      height,
      legend: { show: false },
      padding: [8, 14, 0, 0],
      scales: { x: { time: false, ...xScale }, y: yScale },
      axes: [axis(x, 2), axis(y, 3)],
      series: free ? [null, ...series] : [{}, ...series],
      cursor: {
        show: !free,
        drag: { setScale: false, x: false, y: false },
        y: false,
        points: { size: 6 },
      },
      hooks: {
        drawClear: [() => this.options.under?.(this)],
        draw: [() => this.options.over?.(this)],
        setCursor: [() => this.hovered()],
      },
    };
    this.plot = new uPlot(options, this.data, this.target);
  }

  hovered() {
    this.showValues();
    const { left } = this.plot?.cursor ?? {};
    const over = left !== undefined && left !== null && left >= 0;
    this.options.onHover?.(over && this.plot ? this.plot.posToVal(left, "x") : null);
  }

  /** Show the values at the cursor in the legend. */
  showValues() {
    if (this.options.free) return;
    const index = this.plot?.cursor.idx;
    this.options.lines.forEach((line, i) => {
      const value = index === null || index === undefined ? null : this.data[i + 1][index];
      const text = value === null || value === undefined ? "" : (line.text ?? short)(value);
      if (this.values[i].textContent !== text) this.values[i].textContent = text;
    });
  }

  /** Return the canvas coordinates of a point. @type {(x: number, y: number) => [number, number]} */
  at(x, y) {
    if (!this.plot) return [0, 0];
    return [this.plot.valToPos(x, "x", true), this.plot.valToPos(y, "y", true)];
  }

  /**
   * Draw on the canvas within the plotting area.
   *
   * @param {(context: CanvasRenderingContext2D, box: { left: number, top: number, width: number,
   *   height: number }, ratio: number) => void} draw
   */
  paint(draw) {
    if (!this.plot) return;
    const { ctx, bbox } = this.plot;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.setLineDash([]);
    draw(ctx, bbox, uPlot.pxRatio);
    ctx.restore();
  }

  /**
   * A vertical line at an abscissa, with dots on it.
   *
   * @param {number} x
   * @param {number[]} [dots] ordinates
   */
  mark(x, dots = []) {
    this.paint((context, box, ratio) => {
      const [column] = this.at(x, 0);
      context.strokeStyle = this.theme.accent;
      context.lineWidth = 1.5 * ratio;
      context.beginPath();
      context.moveTo(column, box.top);
      context.lineTo(column, box.top + box.height);
      context.stroke();
      for (const y of dots) this.dot(context, x, y, ratio);
    });
  }

  /** @type {(context: CanvasRenderingContext2D, x: number, y: number, ratio: number) => void} */
  dot(context, x, y, ratio) {
    const [column, row] = this.at(x, y);
    context.beginPath();
    context.arc(column, row, 3.5 * ratio, 0, 2 * Math.PI);
    context.fillStyle = this.theme.accent;
    context.fill();
    context.lineWidth = 1.5 * ratio;
    context.strokeStyle = this.theme.panel;
    context.stroke();
  }

  dispose() {
    this.plot?.destroy();
    this.plot = null;
  }
}

/** A line through points in the order given, which need not rise along x. @type {any} */
function freePath(/** @type {any} */ plot, /** @type {number} */ index) {
  const [xs, ys] = plot.data[index];
  const stroke = new Path2D();
  for (let i = 0; i < xs.length; i++) {
    const [x, y] = [plot.valToPos(xs[i], "x", true), plot.valToPos(ys[i], "y", true)];
    if (i) stroke.lineTo(x, y);
    else stroke.moveTo(x, y);
  }
  return { stroke, fill: null, clip: null, band: null, gaps: null, flags: 1 };
}
