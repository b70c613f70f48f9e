// Plot: values over time, or over each other. It keeps all of a run, zooms by dragging, goes back
// by a double click, and tells the values under the cursor.
import uPlot from "uplot";
import type { Context, Part } from "../context.ts";
import { copyText, element, setText, styleValue } from "../dom.ts";
import { iconButton } from "../icons.ts";
import { formatMultiples, formatNumber, formatUnit } from "../numbers.ts";
import type { PlotTrace, PlotWidget, Range } from "../protocol.ts";
import { csvOf, instantAt } from "../series.ts";
import { TraceFeed } from "../trace_feed.ts";
import { decadeName, decadesWithin, paddedByDecades, phasePath, padded, rangeOf } from "./plot_scales.ts";

/// The colours of the figures' series (output/figures/plot_style.cpp), for the traces of a plot in their order.
export const traceColours = [
  "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#AA3377", "#7F7F7F", "#666600", "#6622EE",
  "#CC0022", "#8888EE", "#22CC00", "#AAAA66", "#226666", "#66AAAA", "#AA6666", "#CC44EE", "#6666AA", "#886644",
];
const defaultHeight = 200;

/// What is drawn otherwise than a file's plots are.
export interface PlotLook {
  /// Of each trace; one that has `dash` is no part of the legend.
  lines: { colour: string; dash?: number[] }[];
  /// Values are drawn on a scale of decades above this size and below its negative, and evenly between.
  even: number;
}

interface Drawn {
  trace: PlotTrace;
  colour: string;
  dash: number[] | undefined;
  scale: string;
  value: HTMLElement; // its number in the legend
}

export function makePlot(context: Context, widget: PlotWidget, look?: PlotLook): Part {
  const overlays = context.overlays.get(widget.trail) ?? [];
  const plots = [widget, ...overlays];
  const phase = plots.some((plot) => plot.traces.some((trace) => trace.x !== null));
  const trails = [...new Set(plots.flatMap((plot) => plot.traces.flatMap((trace) => (trace.of ?? (trace.x === null ? [trace.y] : [trace.x, trace.y])))))];

  const host = element("div", { class: "plot-host" });
  const readout = element("span", { class: "plot-at" });
  const legend = element("div", { class: "plot-legend" });
  const drawn: Drawn[] = [];
  for (const plot of plots) {
    const group = element("div", { role: "group", "aria-label": plot.label, "data-trail": plot === widget ? null : plot.trail });
    for (const trace of plot.traces) {
      const { colour, dash } = look?.lines[drawn.length] ?? { colour: traceColours[drawn.length % traceColours.length], dash: undefined };
      const value = element("span", { class: "number" });
      const swatch = element("span", { class: "swatch", "aria-hidden": "true" });
      swatch.style.background = colour;
      const name = trace.x === null ? trace.label || trace.y : `${trace.label || trace.y} over ${trace.x.slice(trace.x.lastIndexOf(".") + 1)}`;
      if (dash === undefined) group.append(element("span", { class: "plot-trace", title: trace.y }, swatch,
        element("span", {}, name), value, element("span", { class: "unit" }, formatUnit(trace.unit))));
      // Traces of one unit share a scale; those of a plot that is laid over with another have theirs at the right.
      const scale = plot === widget || trace.unit === widget.traces[0]?.unit ? "y" : "right";
      drawn.push({ trace, colour, dash, scale, value });
    }
    legend.append(group);
  }

  const xUnit = phase ? formatUnit(drawn.find((each) => each.trace.x !== null)?.trace.x_unit ?? "") : "s";
  const rangesOf = (scale: string): Range | null => (scale === "y" ? widget.range : overlays.find((plot) => plot.range !== null)?.range ?? null);
  const zoomed: Record<string, Range | null> = { x: null, y: null, right: null };
  const feed = new TraceFeed(context, trails, () => (stale = true));
  const workedOut = new Map<string, { length: number; last: number; column: number[] }>();
  function columnOf(trail: string): number[] {
    const column = feed.series.columns[trails.indexOf(trail)];
    if (column !== undefined) return column;
    const { length, last } = feed.series;
    const known = workedOut.get(trail);
    if (known !== undefined && known.length === length && known.last === last) return known.column;
    const { of, from } = drawn.find((each) => each.trace.y === trail)!.trace;
    const sources = of!.map(columnOf);
    const made = Array.from({ length }, (_, i) => from!(...sources.map((each) => each[i])));
    workedOut.set(trail, { length, last, column: made });
    return made;
  }
  let stale = true;
  let present = NaN; // the moment shown, where that is of the past

  function rangeOfTime(): Range {
    if (zoomed.x !== null) return zoomed.x;
    if (widget.x_range !== null) return widget.x_range;
    const last = Math.max(feed.series.last, 0);
    const shown = Number.isNaN(present) ? last : present;
    if (widget.window !== null && widget.window > 0) return [Math.max(0, shown - widget.window), Math.max(shown, widget.window)];
    return [feed.series.times[0] ?? 0, last > (feed.series.times[0] ?? 0) ? last : (feed.series.times[0] ?? 0) + 1];
  }
  function rangeOfPhase(): Range {
    return zoomed.x ?? widget.x_range ?? padded(rangeOf(drawn.map((each) => (each.trace.x === null ? feed.series.times : columnOf(each.trace.x)))));
  }
  function rangeOfValues(scale: string): Range {
    const fixed = zoomed[scale] ?? rangesOf(scale);
    if (fixed !== null) return fixed;
    const columns = drawn.filter((each) => each.scale === scale).map((each) => columnOf(each.trace.y));
    if (phase) return padded(rangeOf(columns));
    const [begin, end] = rangeOfTime();
    const range = rangeOf(columns, feed.series.times, begin, end);
    return look === undefined ? padded(range) : paddedByDecades(range, look.even);
  }

  function axis(scale: string, label: string, side: uPlot.Axis.Side, colour: string | null): uPlot.Axis {
    const ink = () => colour ?? styleValue("--quiet");
    return {
      scale, side, label, labelSize: 16, labelGap: 0, labelFont: "11px system-ui, sans-serif", font: "11px system-ui, sans-serif",
      size: scale === "x" ? 26 : 54, space: scale === "x" ? 50 : 20, gap: 3, stroke: ink,
      grid: { show: side !== 1, stroke: () => styleValue("--rule"), width: 1 },
      ticks: { show: true, size: 4, stroke: () => styleValue("--rule"), width: 1 },
      ...(look === undefined || scale === "x"
        ? { values: (_: uPlot, ticks: number[]) => formatMultiples(ticks) }
        : { filter: (_: uPlot, ticks: number[]) => ticks, splits: (_: uPlot, _index: number, least: number, greatest: number) => decadesWithin(least, greatest, look.even),
            values: (_: uPlot, ticks: number[]) => ticks.map(decadeName) }),
    };
  }
  const unitsOf = (scale: string) =>
    [...new Set(drawn.filter((each) => each.scale === scale).map((each) => formatUnit(each.trace.unit)))].filter((unit) => unit !== "").join(", ");
  const right = drawn.some((each) => each.scale === "right");
  const chart = new uPlot({
    mode: phase ? 2 : 1,
    width: 300, height: defaultHeight,
    legend: { show: false },
    scales: {
      x: { time: false, auto: true, range: () => (phase ? rangeOfPhase() : rangeOfTime()) },
      y: { auto: true, range: () => rangeOfValues("y"), ...(look === undefined ? {} : { distr: 4 as const, asinh: look.even }) },
      ...(right ? { right: { auto: true, range: () => rangeOfValues("right") } } : {}),
    },
    axes: [
      axis("x", phase ? xUnit : "time [s]", 2, null),
      axis("y", unitsOf("y"), 3, null),
      ...(right ? [axis("right", unitsOf("right"), 1, drawn.find((each) => each.scale === "right")!.colour)] : []),
    ],
    series: [
      {},
      ...drawn.map((each): uPlot.Series => ({
        label: each.trace.label, stroke: each.colour, width: 1.5, pxAlign: 0, ...(each.dash === undefined ? {} : { dash: each.dash }), points: { show: false }, spanGaps: false,
        ...(phase ? { facets: [{ scale: "x", auto: true }, { scale: each.scale, auto: true }], paths: phasePath } : { scale: each.scale }),
      })),
    ],
    cursor: {
      drag: { x: true, y: true, uni: 20, setScale: false },
      points: { show: false },
      // A double click goes back to all; what uPlot does by itself knows nothing of a window that rolls.
      bind: { dblclick: () => () => { unzoom(); return null; } },
    },
    hooks: {
      setSelect: [zoom],
      setCursor: [showReadout],
      draw: [drawPresent],
    },
  }, dataOf() as uPlot.AlignedData, host);

  function dataOf(): unknown {
    if (!phase) return [feed.series.times, ...drawn.map((each) => columnOf(each.trace.y))];
    return [null, ...drawn.map((each) => [each.trace.x === null ? feed.series.times : columnOf(each.trace.x), columnOf(each.trace.y)])];
  }
  function unzoom(): void {
    for (const scale of Object.keys(zoomed)) zoomed[scale] = null;
    stale = true;
  }
  function zoom(plot: uPlot): void {
    const { left, top, width, height } = plot.select;
    if (width < 4 && height < 4) return;
    const full = { x: plot.over.clientWidth, y: plot.over.clientHeight };
    if (width >= 4 && width < full.x) zoomed.x = [plot.posToVal(left, "x"), plot.posToVal(left + width, "x")];
    if (height >= 4 && height < full.y)
      for (const scale of right ? ["y", "right"] : ["y"]) zoomed[scale] = [plot.posToVal(top + height, scale), plot.posToVal(top, scale)];
    plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    stale = true;
  }
  /// The instant under the cursor, or the one that is shown; over each other, the nearest to the cursor.
  function instantUnder(plot: uPlot): number {
    const { left, top } = plot.cursor;
    if (left === undefined || left < 0 || top === undefined) return Number.isNaN(present) ? feed.series.length - 1 : instantAt(feed.series.times, present);
    if (!phase) return plot.posToIdx(left);
    let nearest = -1, least = Infinity;
    const each = drawn[0];
    const xs = each.trace.x === null ? feed.series.times : columnOf(each.trace.x), ys = columnOf(each.trace.y);
    for (let i = 0; i < feed.series.length; ++i) {
      const distance = Math.hypot(plot.valToPos(xs[i], "x") - left, plot.valToPos(ys[i], each.scale) - top);
      if (distance < least) [nearest, least] = [i, distance];
    }
    return nearest;
  }
  function showReadout(plot: uPlot): void {
    const instant = instantUnder(plot);
    const known = instant >= 0 && instant < feed.series.length;
    setText(readout, known ? `${formatNumber(feed.series.times[instant])} s` : "");
    for (const each of drawn) setText(each.value, formatNumber(known ? columnOf(each.trace.y)[instant] : NaN));
  }
  function drawPresent(plot: uPlot): void {
    if (phase || Number.isNaN(present)) return;
    const x = Math.round(plot.valToPos(present, "x", true)) + 0.5;
    const { left, top, width, height } = plot.bbox;
    if (x < left || x > left + width) return;
    plot.ctx.strokeStyle = styleValue("--accent");
    plot.ctx.lineWidth = devicePixelRatio;
    plot.ctx.beginPath();
    plot.ctx.moveTo(x, top);
    plot.ctx.lineTo(x, top + height);
    plot.ctx.stroke();
  }
  function csv(): string {
    const header = trails.map((trail) => {
      const of = drawn.find((each) => each.trace.y === trail || each.trace.x === trail)?.trace;
      const unit = of === undefined ? "" : of.y === trail ? of.unit : of.x_unit;
      return unit === "" ? trail : `${trail} [${unit}]`;
    });
    return csvOf(["time [s]", ...header], [feed.series.times, ...feed.series.columns]);
  }

  const copy = iconButton("copy", "copy as CSV", () => {
    copyText(csv()).then(() => context.notice("note", `${feed.series.length} rows of ${widget.label} copied as CSV`),
      (problem: Error) => context.notice("error", problem.message));
  });
  const frame = element("figure", { class: "plot", "data-trail": widget.trail, "aria-label": widget.label },
    element("figcaption", {}, element("span", { class: "name" }, widget.label), readout, copy), host, legend);
  host.style.height = `${widget.height ?? defaultHeight}px`;
  if (widget.width) frame.style.width = `${widget.width}px`;

  const resize = new ResizeObserver(() => {
    if (host.clientWidth > 0) chart.setSize({ width: host.clientWidth, height: host.clientHeight });
  });
  resize.observe(host);
  const forget = [
    context.onTheme(() => chart.redraw(false, true)),
    context.onSnapshot((snapshot) => {
      const now = snapshot.past ? snapshot.time : NaN;
      if (!Object.is(now, present)) stale = true;
      present = now;
      if (!stale) return;
      stale = false;
      chart.setData(dataOf() as uPlot.AlignedData);
      showReadout(chart);
    }),
  ];
  return {
    element: frame,
    dispose: () => {
      forget.forEach((each) => each());
      feed.dispose();
      resize.disconnect();
      chart.destroy();
    },
  };
}
