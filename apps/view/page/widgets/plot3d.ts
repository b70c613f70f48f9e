// Plot.3D: a trajectory, or a surface over what it has been measured at. Turned by dragging or by arrow keys.
import type { Context, Part } from "../context.ts";
import { element, styleValue } from "../dom.ts";
import { formatMultiples, formatUnit } from "../numbers.ts";
import { makeMaximisable } from "../maximise.ts";
import type { Plot3DWidget, Range } from "../protocol.ts";
import { makeHeightResizable } from "../resizable_height.ts";
import { TraceFeed } from "../trace_feed.ts";
import { traceColours } from "./plot.ts";
import { padded, rangeOf } from "./plot_scales.ts";
import { niceTicks, project, surfaceOf, type Point3, type View } from "./plot3d_geometry.ts";

const defaultHeight = 260;

export function makePlot3D(context: Context, widget: Plot3DWidget): Part {
  const surface = widget.surface ?? null;
  const traces = surface !== null ? [{ ...surface, label: surface.z, unit: "" }] : widget.traces ?? [];
  const trails = [...new Set(traces.flatMap((trace) => [trace.x, trace.y, trace.z]))];
  const canvas = element("canvas", { class: "plot3d", tabindex: 0, role: "img", "aria-label": `${widget.label}: drag or use the arrow keys to turn it` });
  const legend = element("div", { class: "plot-legend" }, ...traces.map((trace, i) => {
    const swatch = element("span", { class: "swatch", "aria-hidden": "true" });
    swatch.style.background = traceColours[i % traceColours.length];
    return element("span", { class: "plot-trace" }, swatch, trace.label);
  }));
  const frame = element("figure", { class: "plot", "data-trail": widget.trail, "aria-label": widget.label },
    element("figcaption", {}, element("span", { class: "name" }, widget.label)), canvas, legend);
  makeMaximisable(frame, frame.querySelector("figcaption")!);
  if (widget.width) frame.style.width = `${widget.width}px`;

  let stale = true;
  const feed = new TraceFeed(context, trails, () => (stale = true));
  const column = (trail: string) => feed.series.columns[trails.indexOf(trail)];
  const view: View = (context.kept.get(widget.trail) as View | undefined) ?? { turn: -0.6, lift: 0.4 };
  context.kept.set(widget.trail, view);
  const units = ["", "", ""];
  // The units of the axes come with the values.
  const unwatch = (["x", "y", "z"] as const).map((axis, i) =>
    traces.length === 0 ? () => {} : context.values.watch(traces[0][axis], (_, unit) => {
      if (units[i] !== unit) stale = true;
      units[i] = unit;
    }));

  function draw(): void {
    const width = canvas.clientWidth, height = canvas.clientHeight;
    if (width === 0 || height === 0) return;
    canvas.width = Math.round(width * devicePixelRatio);
    canvas.height = Math.round(height * devicePixelRatio);
    const pen = canvas.getContext("2d")!;
    pen.scale(devicePixelRatio, devicePixelRatio);
    pen.font = "11px system-ui, sans-serif";
    const ranges = (["x", "y", "z"] as const).map((axis) => padded(rangeOf(traces.map((trace) => column(trace[axis])))));
    const place = (x: number, y: number, z: number) => project(view, ranges as [Range, Range, Range], [x, y, z], width, height);
    drawAxes(pen, ranges, place);
    if (surface !== null) drawSurface(pen, ranges, place);
    else traces.forEach((trace, i) => {
      pen.strokeStyle = traceColours[i % traceColours.length];
      pen.lineWidth = 1.25;
      pen.beginPath();
      const [xs, ys, zs] = [column(trace.x), column(trace.y), column(trace.z)];
      for (let k = 0; k < xs.length; ++k) {
        const at = place(xs[k], ys[k], zs[k]);
        pen.lineTo(at.x, at.y);
      }
      pen.stroke();
    });
  }

  function drawAxes(pen: CanvasRenderingContext2D, ranges: Range[], place: (...point: Point3) => { x: number; y: number }): void {
    const [[x0, x1], [y0, y1], [z0, z1]] = ranges;
    const line = (from: Point3, to: Point3) => {
      const a = place(...from), b = place(...to);
      pen.moveTo(a.x, a.y);
      pen.lineTo(b.x, b.y);
    };
    pen.strokeStyle = styleValue("--rule");
    pen.lineWidth = 1;
    pen.beginPath();
    // The floor, ruled at its ticks, and the upright edges.
    for (const x of niceTicks([x0, x1])) line([x, y0, z0], [x, y1, z0]);
    for (const y of niceTicks([y0, y1])) line([x0, y, z0], [x1, y, z0]);
    for (const [x, y] of [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]) line([x, y, z0], [x, y, z1]);
    line([x0, y0, z0], [x1, y0, z0]);
    line([x1, y0, z0], [x1, y1, z0]);
    line([x1, y1, z0], [x0, y1, z0]);
    line([x0, y1, z0], [x0, y0, z0]);
    pen.stroke();
    pen.fillStyle = styleValue("--quiet");
    const middle = place((x0 + x1) / 2, (y0 + y1) / 2, z0);
    const write = (text: string, at: { x: number; y: number }, far: number) => {
      const distance = Math.hypot(at.x - middle.x, at.y - middle.y) || 1;
      const dx = (at.x - middle.x) / distance;
      pen.textAlign = dx > 0.3 ? "left" : dx < -0.3 ? "right" : "center";
      pen.fillText(text, at.x + far * dx, at.y + (far * (at.y - middle.y)) / distance + 4);
    };
    // Numbers stand along the edges that are nearest to the eye.
    const nearY = place((x0 + x1) / 2, y0, z0).y > place((x0 + x1) / 2, y1, z0).y ? y0 : y1;
    const nearX = place(x0, (y0 + y1) / 2, z0).y > place(x1, (y0 + y1) / 2, z0).y ? x0 : x1;
    const label = (name: string, unit: string) => (unit === "" ? name : `${name} [${formatUnit(unit)}]`);
    const names = traces.length > 0 ? (["x", "y", "z"] as const).map((axis) => traces[0][axis].split(".").slice(-2).join(".")) : ["x", "y", "z"];
    const ticksX = niceTicks([x0, x1]), ticksY = niceTicks([y0, y1]), ticksZ = niceTicks([z0, z1]);
    formatMultiples(ticksX).forEach((text, i) => write(text, place(ticksX[i], nearY, z0), 8));
    formatMultiples(ticksY).forEach((text, i) => write(text, place(nearX, ticksY[i], z0), 8));
    const left = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(([x, y]) => ({ x, y, at: place(x, y, z0) })).reduce((a, b) => (b.at.x < a.at.x ? b : a));
    pen.textAlign = "right";
    formatMultiples(ticksZ).forEach((text, i) => {
      const at = place(left.x, left.y, ticksZ[i]);
      pen.fillText(text, at.x - 6, at.y + 4);
    });
    pen.fillStyle = styleValue("--ink");
    write(label(names[0], units[0]), place((x0 + x1) / 2, nearY, z0), 26);
    write(label(names[1], units[1]), place(nearX, (y0 + y1) / 2, z0), 26);
    const top = place(left.x, left.y, z1);
    pen.textAlign = "left";
    pen.fillText(label(names[2], units[2]), Math.max(2, top.x - 40), Math.max(12, top.y - 8));
  }

  function drawSurface(pen: CanvasRenderingContext2D, ranges: Range[], place: (...point: Point3) => { x: number; y: number; depth: number }): void {
    const tiles = surfaceOf(column(surface!.x), column(surface!.y), column(surface!.z), ranges[0], ranges[1])
      .map((corners) => ({ corners: corners.map((corner) => place(...corner)), height: corners.reduce((sum, corner) => sum + corner[2], 0) / corners.length }));
    const depth = (tile: (typeof tiles)[number]) => tile.corners.reduce((sum, corner) => sum + corner.depth, 0) / tile.corners.length;
    tiles.sort((a, b) => depth(b) - depth(a));
    pen.strokeStyle = styleValue("--panel");
    pen.lineWidth = 0.5;
    for (const tile of tiles) {
      const part = (tile.height - ranges[2][0]) / (ranges[2][1] - ranges[2][0]);
      pen.fillStyle = `hsl(205 70% ${(25 + 50 * part).toFixed(0)}%)`;
      pen.beginPath();
      for (const corner of tile.corners) pen.lineTo(corner.x, corner.y);
      pen.closePath();
      pen.fill();
      pen.stroke();
    }
  }

  const turn = (by: number, lift: number) => {
    view.turn += by;
    view.lift = Math.min(1.5, Math.max(0, view.lift + lift));
    stale = true;
  };
  canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener("pointermove", (event) => {
    if (canvas.hasPointerCapture(event.pointerId)) turn(event.movementX * 0.01, event.movementY * 0.01);
  });
  canvas.addEventListener("keydown", (event) => {
    const steps: Record<string, [number, number]> = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] };
    if (!(event.key in steps)) return;
    event.preventDefault();
    event.stopPropagation();
    turn(...steps[event.key]);
  });
  const resize = new ResizeObserver(() => (stale = true));
  resize.observe(canvas);
  const forget = [
    makeHeightResizable(context, frame, canvas, widget.trail, widget.height ?? defaultHeight),
    context.onTheme(() => (stale = true)),
    context.onSnapshot(() => {
      if (stale) draw();
      stale = false;
    }),
  ];
  return {
    element: frame,
    dispose: () => {
      [...forget, ...unwatch].forEach((each) => each());
      resize.disconnect();
      feed.dispose();
    },
  };
}
