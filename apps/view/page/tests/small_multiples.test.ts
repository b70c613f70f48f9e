import assert from "node:assert/strict";
import { test } from "node:test";
import type { PlotWidget } from "../protocol.ts";
import { panelsOf } from "../widgets/small_multiples.ts";

const plot = (units: string[], x: string | null = null): PlotWidget => ({
  type: "Plot", trail: "p", label: "P", height: 300, range: [0, 1], x_range: null, window: null, overlay: null,
  traces: units.map((unit, i) => ({ x, y: `y${i}`, label: "", unit, x_unit: "s" })),
});

test("one or two units stand in one plot, and so do values over each other", () => {
  for (const widget of [plot([]), plot(["m"]), plot(["m", "N", "m"]), plot(["m", "N", "J"], "x")]) assert.deepEqual(panelsOf(widget), [widget]);
});

test("three units have three panels, each with its lines; the range is of the first", () => {
  const panels = panelsOf(plot(["m", "N.m", "m", ""]));
  assert.deepEqual(panels.map((each) => [each.label, each.traces.map((trace) => trace.y), each.range, each.height]),
    [["P [m]", ["y0", "y2"], [0, 1], 100], ["P [N\u00b7m]", ["y1"], null, 100], ["P", ["y3"], null, 100]]);
  assert.equal(new Set(panels.map((each) => each.trail)).size, 3);
});
