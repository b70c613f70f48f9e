// A plot over time whose lines have more than two units: a panel for each unit, one below the other. They share time as all plots do.
import type { Context, Part } from "../context.ts";
import { element } from "../dom.ts";
import { formatUnit } from "../numbers.ts";
import type { PlotWidget } from "../protocol.ts";
import { makePlot } from "./plot.ts";

const mostAxes = 2; // of values, in one plot
const leastHeight = 90; // of a panel [CSS pixels]

/// The plot itself, or one for each unit where an axis would be missing.
export function panelsOf(widget: PlotWidget): PlotWidget[] {
  const units = [...new Set(widget.traces.map((trace) => trace.unit))];
  if (units.length <= mostAxes || widget.traces.some((trace) => trace.x !== null)) return [widget];
  return units.map((unit, i) => ({
    ...widget,
    trail: `${widget.trail} ${i + 1}`,
    label: unit === "" ? widget.label : `${widget.label} [${formatUnit(unit)}]`,
    traces: widget.traces.filter((trace) => trace.unit === unit),
    range: i === 0 ? widget.range : null,
    height: widget.height ? Math.max(leastHeight, widget.height / units.length) : leastHeight,
  }));
}

export function makePlotPanels(context: Context, widget: PlotWidget): Part {
  const panels = context.overlays.has(widget.trail) ? [widget] : panelsOf(widget);
  if (panels.length === 1) return makePlot(context, widget);
  const parts = panels.map((panel) => makePlot(context, panel));
  return {
    element: element("div", { class: "multiples", role: "group", "data-trail": widget.trail, "aria-label": widget.label }, ...parts.map((part) => part.element)),
    dispose: () => parts.forEach((part) => part.dispose()),
  };
}
