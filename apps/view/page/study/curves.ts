// A figure of curves: what was measured as marks joined by a line, closed forms dashed, in the
// subjects' colours; on a logarithmic axis what counts as zero stands in a lane at the foot, and
// runs that did not finish are crosses at the top. It zooms by dragging and tells the value under
// the cursor.
import uPlot from "uplot";
import { element, setText, styleValue } from "../dom.ts";
import { formatNumber, formatUnit } from "../numbers.ts";
import type { Axis, CurvesFigure, FigureSeries } from "./protocol.ts";

const height = 260;
const markSize = 3.2; // CSS pixels, from the middle
const predictedDashes = [7, 4]; // CSS pixels, as in the report
const mostMarks = 60; // beyond, a curve is a line alone
const reach = 24; // of the cursor, CSS pixels

type Panel = CurvesFigure["panels"][number];
type Range = [number, number];

export class CurvesView {
  readonly element: HTMLElement;
  private readonly panels: PanelView[] = [];
  private readonly grid = element("div", { class: "study-panels" });
  private readonly legend = element("div", { class: "study-legend" });

  constructor(private figure: CurvesFigure) {
    this.element = element("div", {}, this.legend, this.grid);
    this.update(figure);
  }

  update(figure: CurvesFigure): void {
    this.figure = figure;
    this.grid.style.setProperty("--across", String(figure.across));
    this.grid.classList.toggle("single", figure.panels.length === 1);
    while (this.panels.length > figure.panels.length) this.panels.pop()!.dispose();
    figure.panels.forEach((panel, index) => {
      if (index < this.panels.length) return;
      this.panels.push(new PanelView(this.figure, panel));
      this.grid.append(this.panels[index].element);
    });
    const shared = figure.own_axes ? null : scaleOf(figure.y, figure.panels.flatMap((panel) => panel.series));
    const across = rangeOfX(figure.x, figure.panels.flatMap((panel) => panel.series));
    figure.panels.forEach((panel, index) => this.panels[index].update(figure, panel, across, shared ?? scaleOf(figure.y, panel.series)));
    this.showLegend(figure.panels.flatMap((panel) => panel.series));
  }

  redraw(): void {
    for (const panel of this.panels) panel.redraw();
  }

  dispose(): void {
    for (const panel of this.panels) panel.dispose();
  }

  private showLegend(series: FigureSeries[]): void {
    const named = new Map(series.map((each) => [each.label, each]));
    this.legend.replaceChildren(...[...named.values()].map((each) => {
      const sample = element("canvas", { class: "study-sample", width: 36, height: 20, "aria-hidden": "true" });
      const ink = sample.getContext("2d")!;
      ink.scale(2, 2);
      ink.strokeStyle = ink.fillStyle = each.reference ? styleValue("--ink") : each.colour;
      ink.lineWidth = 1.25;
      ink.setLineDash(each.dashes.map((length) => length / 2));
      ink.beginPath();
      ink.moveTo(0, 5);
      ink.lineTo(18, 5);
      ink.stroke();
      ink.setLineDash([]);
      if (!each.reference) drawMark(ink, each.marker, 9, 5, markSize, false);
      return element("span", {}, sample, each.label);
    }));
  }
}

/// What an axis of values shows: where all lie, and where zero stands.
interface Scale {
  range: Range;
  zero: number | null; // of a logarithmic axis: the place of what counts as zero, if anything does
}

class PanelView {
  readonly element: HTMLElement;
  private readonly chart: uPlot;
  private readonly heading = element("h4");
  private readonly readout = element("output", { class: "study-readout" });
  private readonly resize: ResizeObserver;
  private series: FigureSeries[] = [];
  private scale: Scale = { range: [0, 1], zero: null };
  private across: Range = [0, 1];
  private zoomed: { x: Range | null; y: Range | null } = { x: null, y: null };

  constructor(private figure: CurvesFigure, panel: Panel) {
    const host = element("div", { class: "study-chart" });
    this.element = element("div", { class: "study-panel", role: "group", "aria-label": panel.title || figure.title },
      element("div", { class: "study-panel-head" }, this.heading, this.readout), host);
    const axis = (scale: "x" | "y", of: Axis): uPlot.Axis => ({
      scale,
      label: of.unit === "" ? of.label : `${of.label} [${formatUnit(of.unit)}]`,
      labelSize: 18, labelGap: 0, labelFont: "11px system-ui, sans-serif", font: "11px system-ui, sans-serif",
      size: scale === "x" ? 28 : 58, gap: 3,
      stroke: () => styleValue("--quiet"),
      grid: { stroke: () => styleValue("--rule"), width: 1 },
      ticks: { size: 4, stroke: () => styleValue("--rule"), width: 1 },
      values: (_, ticks) => ticks.map((tick) => this.tickText(of, scale, tick)),
      ...(of.logarithmic ? { splits: (chart) => this.decades(chart, scale), filter: (_, ticks) => ticks } : {}),
    });
    const distribution = (of: Axis) => ({ distr: (of.logarithmic ? 3 : 1) as uPlot.Scale.Distr, log: 10 as const });
    this.chart = new uPlot({
      width: 300, height,
      legend: { show: false },
      scales: {
        x: { time: false, auto: true, ...distribution(figure.x), range: () => this.zoomed.x ?? this.across },
        y: { auto: true, ...distribution(figure.y), range: () => this.zoomed.y ?? this.scale.range },
      },
      axes: [axis("x", figure.x), axis("y", figure.y)],
      // uPlot holds scales, axes, zoom and cursor; the curves are drawn here, each with its own x.
      series: [{}, { show: true, scale: "y", paths: () => null, points: { show: false } }],
      cursor: {
        points: { show: false }, y: true,
        drag: { x: true, y: true, uni: 20, setScale: false },
        bind: { dblclick: () => () => { this.zoomed = { x: null, y: null }; this.rescale(); return null; } },
      },
      hooks: {
        setSelect: [(chart) => this.zoom(chart)],
        setCursor: [(chart) => this.showReadout(chart)],
        draw: [(chart) => this.draw(chart)],
      },
    }, [[0, 1], [null, null]], host);
    this.resize = new ResizeObserver(() => {
      if (host.clientWidth > 0) this.chart.setSize({ width: host.clientWidth, height });
    });
    this.resize.observe(host);
  }

  update(figure: CurvesFigure, panel: Panel, across: Range, scale: Scale): void {
    this.figure = figure;
    this.series = panel.series;
    this.scale = scale;
    this.across = across;
    setText(this.heading, panel.title);
    this.heading.hidden = panel.title === "";
    this.rescale();
  }

  redraw(): void {
    this.chart.redraw(false, true);
  }

  dispose(): void {
    this.resize.disconnect();
    this.chart.destroy();
    this.element.remove();
  }

  private rescale(): void {
    // Its ends are all that uPlot needs to know of the data.
    this.chart.setData([this.across, this.scale.range]);
  }

  private tickText(axis: Axis, scale: "x" | "y", tick: number | null): string {
    if (tick === null) return "";
    return scale === "y" && tick === this.scale.zero ? `\u2264 ${formatShort(axis.floor)}` : formatShort(tick);
  }

  /// The ticks of a logarithmic axis: powers of ten, as many as there is room for, and the lane of zero.
  private decades(chart: uPlot, scale: "x" | "y"): number[] {
    const { min = 1e-3, max = 1 } = chart.scales[scale];
    const first = Math.ceil(Math.log10(min!) - 1e-9), last = Math.floor(Math.log10(max!) + 1e-9);
    const room = (scale === "x" ? chart.width / 60 : chart.height / 28) || 1;
    const step = Math.max(1, Math.ceil((last - first + 1) / room));
    // Within a decade its round values are all there is.
    const ticks = last > first ? [] : [1, 2, 5, 10, 20, 50].map((part) => part * 10 ** (first - 1)).filter((tick) => tick >= min! && tick <= max!);
    for (let power = first; power <= last && last > first; power += step) ticks.push(Number(`1e${power}`));
    const zero = scale === "y" ? this.scale.zero : null;
    return zero === null || zero < min! ? ticks : [zero, ...ticks.filter((tick) => tick > 9 * zero)];
  }

  /// Where a value stands, and whether it stands for itself.
  private place(value: number): { at: number; hollow: boolean } {
    if (!this.figure.y.logarithmic) return { at: value, hollow: false };
    if (Math.abs(value) <= this.figure.y.floor) return { at: this.scale.zero ?? this.figure.y.floor, hollow: true };
    return { at: Math.abs(value), hollow: value < 0 };
  }

  private draw(chart: uPlot): void {
    const ink = chart.ctx, pixels = devicePixelRatio;
    const { left, top, width, height: tall } = chart.bbox;
    ink.save();
    ink.beginPath();
    ink.rect(left, top, width, tall);
    ink.clip();
    for (const series of this.series) {
      const colour = series.reference ? styleValue("--ink") : series.colour;
      ink.strokeStyle = ink.fillStyle = colour;
      ink.lineWidth = 1.25 * pixels;
      ink.setLineDash((series.reference ? series.dashes : predictedDashes).map((length) => length * pixels));
      this.drawLine(chart, series.predicted);
      ink.setLineDash(series.dashes.map((length) => length * pixels));
      if (series.measured.x.length > 1) this.drawLine(chart, series.measured);
      ink.setLineDash([]);
      if (series.measured.x.length <= mostMarks)
        series.measured.x.forEach((x, i) => {
          const { at, hollow } = this.place(series.measured.y[i]);
          drawMark(ink, series.marker, chart.valToPos(x, "x", true), chart.valToPos(at, "y", true), markSize * pixels, hollow);
        });
      for (const x of series.unfinished) drawCross(ink, chart.valToPos(x, "x", true), top + 7 * pixels, 3.5 * pixels);
    }
    ink.restore();
  }

  private drawLine(chart: uPlot, curve: { x: number[]; y: number[] }): void {
    const ink = chart.ctx;
    ink.beginPath();
    curve.x.forEach((x, i) => ink.lineTo(chart.valToPos(x, "x", true), chart.valToPos(this.place(curve.y[i]).at, "y", true)));
    ink.stroke();
  }

  private zoom(chart: uPlot): void {
    const { left, top, width, height: tall } = chart.select;
    if (width < 4 && tall < 4) return;
    if (width >= 4 && width < chart.over.clientWidth) this.zoomed.x = [chart.posToVal(left, "x"), chart.posToVal(left + width, "x")];
    if (tall >= 4 && tall < chart.over.clientHeight) this.zoomed.y = [chart.posToVal(top + tall, "y"), chart.posToVal(top, "y")];
    chart.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    this.rescale();
  }

  private showReadout(chart: uPlot): void {
    const { left = -1, top = -1 } = chart.cursor;
    let text = "", least = reach;
    if (left >= 0)
      for (const series of this.series)
        for (const curve of [series.measured, series.predicted])
          curve.x.forEach((x, i) => {
            const distance = Math.hypot(chart.valToPos(x, "x") - left, chart.valToPos(this.place(curve.y[i]).at, "y") - top);
            if (distance >= least) return;
            least = distance;
            const what = curve === series.predicted && !series.reference ? `${series.label}, predicted` : series.label;
            text = `${what}: ${withUnit(x, this.figure.x)}, ${withUnit(curve.y[i], this.figure.y)}`;
          });
    setText(this.readout, text);
  }
}

function withUnit(value: number, axis: Axis): string {
  return `${formatNumber(value, 4)} ${formatUnit(axis.unit)}`.trim();
}

/// As an axis has it: no zeros at the end.
function formatShort(value: number): string {
  const size = Math.abs(value);
  const text = size !== 0 && (size < 1e-3 || size >= 1e5) ? value.toExponential(3).replace(/\.?0+e/, "e").replace("e+", "e") : String(Number(value.toPrecision(6)));
  return text.replaceAll("-", "\u2212");
}

function rangeOfX(axis: Axis, series: FigureSeries[]): Range {
  const values = series.flatMap((each) => [...each.measured.x, ...each.predicted.x, ...each.unfinished]).filter((x) => !axis.logarithmic || x > 0);
  return aired(axis, values);
}

function scaleOf(axis: Axis, series: FigureSeries[]): Scale {
  const values = series.flatMap((each) => [...each.measured.y, ...each.predicted.y]);
  if (!axis.logarithmic) return { range: aired(axis, values), zero: null };
  const sizes = values.map(Math.abs).filter((size) => size > axis.floor);
  if (sizes.length === values.length) return { range: aired(axis, sizes), zero: null };
  // The lane of what counts as zero: the power of ten below all others.
  const zero = sizes.length === 0 ? axis.floor : 10 ** (Math.floor(Math.log10(least(sizes))) - 1);
  return { range: aired(axis, [zero, ...sizes]), zero };
}

function least(values: number[]): number {
  return values.reduce((a, b) => Math.min(a, b), Infinity);
}

/// The range of values with a little air around.
function aired(axis: Axis, values: number[]): Range {
  if (values.length === 0) return axis.logarithmic ? [1e-3, 1] : [0, 1];
  const low = least(values), high = values.reduce((a, b) => Math.max(a, b), -Infinity);
  if (axis.logarithmic) {
    const air = Math.max(0.05 * Math.log10(high / low), 0.15);
    return [low / 10 ** air, high * 10 ** air];
  }
  const span = high - low > 1e-12 * Math.max(Math.abs(low), Math.abs(high)) ? high - low : Math.abs(high) || 1;
  return [low - 0.06 * span, high + 0.06 * span];
}

/// Filled or hollow; the five shapes of the figures.
function drawMark(ink: CanvasRenderingContext2D, marker: number, x: number, y: number, size: number, hollow: boolean): void {
  const corners = [0, 4, 3, 4, 5][marker];
  const turn = [0, Math.PI / 4, -Math.PI / 2, 0, -Math.PI / 2][marker];
  ink.beginPath();
  if (corners === 0) ink.arc(x, y, size, 0, 2 * Math.PI);
  for (let i = 0; i < corners; ++i) ink.lineTo(x + 1.25 * size * Math.cos(turn + (2 * Math.PI * i) / corners), y + 1.25 * size * Math.sin(turn + (2 * Math.PI * i) / corners));
  ink.closePath();
  if (hollow) {
    const colour = ink.fillStyle;
    ink.fillStyle = styleValue("--panel");
    ink.fill();
    ink.fillStyle = colour;
    ink.stroke();
  } else ink.fill();
}

function drawCross(ink: CanvasRenderingContext2D, x: number, y: number, size: number): void {
  ink.beginPath();
  ink.moveTo(x - size, y - size);
  ink.lineTo(x + size, y + size);
  ink.moveTo(x - size, y + size);
  ink.lineTo(x + size, y - size);
  ink.stroke();
}
