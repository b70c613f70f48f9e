// Plot: values over time, or over each other. It keeps all of a run, zooms by dragging and by the wheel, goes back
// by a double click, and tells the values at the time under the pointer. Plots over time share that time and what stretch they show.
import uPlot from "uplot";
import type { Context, Part } from "../context.ts";
import { copyText, element, setText, styleValue } from "../dom.ts";
import { iconButton } from "../icons.ts";
import { engineering, formatMultiples, formatNumber, formatUnit } from "../numbers.ts";
import { makeMaximisable } from "../maximise.ts";
import { makeLayable } from "../over_camera.ts";
import type { PlotTrace, PlotWidget, Range } from "../protocol.ts";
import { makeHeightResizable } from "../resizable_height.ts";
import { csvOf, instantAt } from "../series.ts";
import { TraceFeed } from "../trace_feed.ts";
import { makeLegendEntry, type LegendEntry } from "./plot_legend.ts";
import { clickSeeks, wheelZooms } from "./plot_pointer.ts";
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
  key: string; // under which it is hidden
  scale: string;
  entry: LegendEntry | null; // in the legend
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
  const keptHidden = `${widget.trail} hidden`;
  const hidden = (context.kept.get(keptHidden) as Set<string> | undefined) ?? new Set<string>();
  context.kept.set(keptHidden, hidden);
  const firstUnit = widget.traces[0]?.unit;
  for (const plot of plots) {
    const group = element("div", { role: "group", "aria-label": plot.label, "data-trail": plot === widget ? null : plot.trail });
    for (const trace of plot.traces) {
      const { colour, dash } = look?.lines[drawn.length] ?? { colour: traceColours[drawn.length % traceColours.length], dash: undefined };
      const name = trace.x === null ? trace.label || trace.y : `${trace.label || trace.y} over ${trace.x.slice(trace.x.lastIndexOf(".") + 1)}`;
      // What is predicted for a line has its colour and is hidden with it.
      const key = look === undefined ? trace.y : colour;
      const entry = dash === undefined ? makeLegendEntry(name, trace.y, colour, !hidden.has(key), (shown) => show(key, shown)) : null;
      if (entry !== null) group.append(entry.element);
      // Traces of one unit share a scale; those of another have theirs at the right.
      const scale = trace.unit === firstUnit ? "y" : "right";
      drawn.push({ trace, colour, dash, key, scale, entry });
    }
    legend.append(group);
  }

  const xUnit = phase ? formatUnit(drawn.find((each) => each.trace.x !== null)?.trace.x_unit ?? "") : "s";
  const rangesOf = (scale: string): Range | null => (scale === "y" ? widget.range : overlays.find((plot) => plot.range !== null)?.range ?? null);
  // Of this plot alone; what stretch of time is shown is shared.
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
  let pointing = false; // the pointer is in this plot
  let stretch = context.time.stretch; // that was drawn
  let present = NaN; // the moment shown, where that is of the past

  function rangeOfTime(): Range {
    if (context.time.stretch !== null) return context.time.stretch;
    if (widget.x_range !== null) return widget.x_range;
    const last = Math.max(feed.series.last, 0);
    const shown = Number.isNaN(present) ? last : present;
    if (widget.window !== null && widget.window > 0) return [Math.max(0, shown - widget.window), Math.max(shown, widget.window)];
    return wholeTime();
  }
  function wholeTime(): Range {
    const first = feed.series.times[0] ?? 0, last = Math.max(feed.series.last, 0);
    return [first, last > first ? last : first + 1];
  }
  function rangeOfPhase(): Range {
    return zoomed.x ?? widget.x_range ?? padded(rangeOf(drawn.map((each) => (each.trace.x === null ? feed.series.times : columnOf(each.trace.x)))));
  }
  function rangeOfValues(scale: string): Range {
    const fixed = zoomed[scale] ?? rangesOf(scale);
    if (fixed !== null) return fixed;
    const columns = drawn.filter((each) => each.scale === scale && !hidden.has(each.key)).map((each) => columnOf(each.trace.y));
    if (phase) return padded(rangeOf(columns));
    const [begin, end] = rangeOfTime();
    const range = rangeOf(columns, feed.series.times, begin, end);
    return look === undefined ? padded(range) : paddedByDecades(range, look.even);
  }

  function axis(scale: string, side: uPlot.Axis.Side, colour: string | null): uPlot.Axis {
    const ink = () => colour ?? styleValue("--quiet");
    return {
      scale, side, label: scale === "x" ? (phase ? xUnit : "time [s]") : () => (look === undefined ? unitOf(scale).unit : ""), labelSize: 16, labelGap: 0, labelFont: "11px system-ui, sans-serif", font: "11px system-ui, sans-serif",
      size: scale === "x" ? 26 : 54, space: scale === "x" ? 50 : (_: uPlot, _axis: number, _least: number, _greatest: number, length: number) => Math.max(20, length / 7), gap: 3, stroke: ink,
      grid: { show: side !== 1, stroke: () => styleValue("--rule"), width: 1 },
      ticks: { show: true, size: 4, stroke: () => styleValue("--rule"), width: 1 },
      ...(look === undefined || scale === "x"
        ? { values: (_: uPlot, ticks: number[]) => formatMultiples(ticks.map((tick) => (tick === null ? null : tick / unitOf(scale).factor))) }
        : { filter: (_: uPlot, ticks: number[]) => ticks, splits: (_: uPlot, _index: number, least: number, greatest: number) => decadesWithin(least, greatest, look.even),
            values: (_: uPlot, ticks: number[]) => ticks.map((tick) => decadeName(tick, firstUnit ?? "")) }),
    };
  }
  /// The unit in which a scale's values are read, and what they are divided by.
  function unitOf(scale: string): { factor: number; unit: string } {
    const units = [...new Set(drawn.filter((each) => each.scale === scale).map((each) => each.trace.unit))].filter((unit) => unit !== "");
    if (scale === "x" || units.length !== 1) return { factor: 1, unit: units.map(formatUnit).join(", ") };
    return engineering(Math.max(...rangeOfValues(scale).map(Math.abs)), units[0]);
  }
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
      axis("x", 2, null),
      axis("y", 3, null),
      ...(right ? [axis("right", 1, drawn.find((each) => each.scale === "right")!.colour)] : []),
    ],
    series: [
      {},
      ...drawn.map((each): uPlot.Series => ({
        label: each.trace.label, show: !hidden.has(each.key), stroke: each.colour, width: 1.5, pxAlign: 0, ...(each.dash === undefined ? {} : { dash: each.dash }), points: { show: false }, spanGaps: false,
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
      setCursor: [(plot) => {
        const time = timeUnder(plot);
        if (!Number.isNaN(time)) context.time.point(time);
        else if (pointing) context.time.point(null);
        pointing = !Number.isNaN(time);
      }],
      draw: [drawPresent],
    },
  }, dataOf() as uPlot.AlignedData, host);
  const mark = element("div", { class: phase ? "plot-dot" : "plot-line" });
  mark.hidden = true;
  chart.over.append(mark);
  clickSeeks(chart, context, () => timeUnder(chart));

  function dataOf(): unknown {
    if (!phase) return [feed.series.times, ...drawn.map((each) => columnOf(each.trace.y))];
    return [null, ...drawn.map((each) => [each.trace.x === null ? feed.series.times : columnOf(each.trace.x), columnOf(each.trace.y)])];
  }
  function unzoom(): void {
    for (const scale of Object.keys(zoomed)) zoomed[scale] = null;
    if (!phase) context.time.show(null);
    drawSoon();
  }
  function show(key: string, shown: boolean): void {
    if (shown) hidden.delete(key);
    else hidden.add(key);
    drawn.forEach((each, i) => {
      if (each.key === key) chart.setSeries(i + 1, { show: shown });
    });
    drawSoon();
  }
  function zoom(plot: uPlot): void {
    const { left, top, width, height } = plot.select;
    if (width < 4 && height < 4) return;
    const full = { x: plot.over.clientWidth, y: plot.over.clientHeight };
    if (width >= 4 && width < full.x) {
      const across: Range = [plot.posToVal(left, "x"), plot.posToVal(left + width, "x")];
      if (phase) zoomed.x = across;
      else context.time.show(across);
    }
    if (height >= 4 && height < full.y)
      for (const scale of right ? ["y", "right"] : ["y"]) zoomed[scale] = [plot.posToVal(top + height, scale), plot.posToVal(top, scale)];
    plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    drawSoon();
  }
  /// The time under the pointer of this plot, NaN where it is elsewhere; over each other, of the nearest point.
  function timeUnder(plot: uPlot): number {
    const { left, top } = plot.cursor;
    if (left === undefined || left < 0 || top === undefined) return NaN;
    if (!phase) return plot.posToVal(left, "x");
    let nearest = -1, least = Infinity;
    const each = drawn[0];
    const xs = each.trace.x === null ? feed.series.times : columnOf(each.trace.x), ys = columnOf(each.trace.y);
    for (let i = 0; i < feed.series.length; ++i) {
      const distance = Math.hypot(plot.valToPos(xs[i], "x") - left, plot.valToPos(ys[i], each.scale) - top);
      if (distance < least) [nearest, least] = [i, distance];
    }
    return nearest >= 0 ? feed.series.times[nearest] : NaN;
  }
  /// The instant at the time under the pointer, in whatever plot, or at the time shown.
  function instantToRead(): number {
    const time = context.time.pointed ?? present;
    return Number.isNaN(time) ? feed.series.length - 1 : instantAt(feed.series.times, time);
  }
  function showReadout(): void {
    const instant = instantToRead();
    const known = instant >= 0 && instant < feed.series.length;
    setText(readout, known ? `${formatNumber(feed.series.times[instant])} s` : "");
    const units = { y: unitOf("y"), right: unitOf("right") };
    for (const each of drawn) {
      if (each.entry === null) continue;
      const value = known ? columnOf(each.trace.y)[instant] : NaN;
      const { factor, unit } = look === undefined ? units[each.scale as "y" | "right"] : engineering(Math.abs(value), each.trace.unit);
      each.entry.say(formatNumber(value / factor), unit);
    }
    showMark(instant, known);
  }
  /// Marks the time under the pointer of another plot: by a line, or by a dot where values are over each other.
  function showMark(instant: number, known: boolean): void {
    const time = context.time.pointed;
    const { clientWidth, clientHeight } = chart.over;
    mark.hidden = time === null || !known;
    if (time === null || !known) return;
    const each = drawn[0];
    const x = chart.valToPos(!phase || each.trace.x === null ? time : columnOf(each.trace.x)[instant], "x");
    const y = phase ? chart.valToPos(columnOf(each.trace.y)[instant], each.scale) : 0;
    mark.hidden = !(x >= 0 && x <= clientWidth && y >= 0 && y <= clientHeight);
    mark.style.translate = `${x}px ${y}px`;
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
  const title = frame.querySelector("figcaption")!;
  makeMaximisable(frame, title);
  if (widget.width) frame.style.width = `${widget.width}px`;

  let asked = 0;
  function drawSoon(): void {
    stale = true;
    if (asked === 0) asked = requestAnimationFrame(draw);
  }
  function draw(): void {
    asked = 0;
    if (!stale) return;
    stale = false;
    chart.setData(dataOf() as uPlot.AlignedData);
    showReadout();
  }
  const resize = new ResizeObserver(() => {
    if (host.clientWidth > 0) chart.setSize({ width: host.clientWidth, height: host.clientHeight });
  });
  resize.observe(host);
  const forget = [
    makeLayable(context, frame, title, widget),
    makeHeightResizable(context, frame, host, widget.trail, widget.height ?? defaultHeight),
    ...(phase ? [] : [wheelZooms(chart, context, { shown: rangeOfTime, whole: wholeTime })]),
    context.onTheme(() => chart.redraw(false, true)),
    context.onSnapshot((snapshot) => {
      const now = snapshot.past ? snapshot.time : NaN;
      if (!Object.is(now, present)) stale = true;
      present = now;
      draw();
    }),
    context.time.onChange(() => {
      if (!phase && stretch !== context.time.stretch) {
        stretch = context.time.stretch;
        drawSoon();
      }
      showReadout();
    }),
  ];
  return {
    element: frame,
    dispose: () => {
      forget.forEach((each) => each());
      if (pointing) context.time.point(null);
      if (asked !== 0) cancelAnimationFrame(asked);
      feed.dispose();
      resize.disconnect();
      chart.destroy();
    },
  };
}
