// Window: a frame with a title that holds other widgets. Controls stand below each other, cameras,
// plots and frames beside each other as far as there is room.
import type { Context, Part } from "../context.ts";
import { element } from "../dom.ts";
import { hasCamera, hasPlot } from "../layout.ts";
import type { Widget, WindowWidget } from "../protocol.ts";
import { makeButton } from "./button.ts";
import { makeCamera } from "./camera.ts";
import { makeChoice } from "./choice.ts";
import { makeCounter } from "./counter.ts";
import { makeDial } from "./dial.ts";
import { makeInput } from "./input.ts";
import { makeLightButton } from "./light_button.ts";
import { makePlot3D } from "./plot3d.ts";
import { makeSlider } from "./slider.ts";
import { makePlotPanels } from "./small_multiples.ts";
import { makeTable } from "./table.ts";
import { makeText } from "./text.ts";

/// The part of the page that a widget of the file is; null for a plot that is laid over another.
export function makeWidget(context: Context, widget: Widget): Part | null {
  const part = makePart(context, widget);
  const controls = widget.type.startsWith("Valuator.") || widget.type.startsWith("Button");
  if (part !== null && controls && context.description.kind === "movie") hold(part.element);
  return part;
}

/// What a movie holds is shown and not changed.
function hold(part: HTMLElement): void {
  for (const control of [part, ...part.querySelectorAll("*")])
    if (control instanceof HTMLInputElement || control instanceof HTMLButtonElement || control instanceof HTMLSelectElement) control.disabled = true;
    else if (control.getAttribute("tabindex") !== null) control.setAttribute("aria-disabled", "true");
}

function makePart(context: Context, widget: Widget): Part | null {
  switch (widget.type) {
    case "Window": return makeWindow(context, widget);
    case "Window.grob": return makeCamera(context, widget);
    case "Valuator.Slider": return makeSlider(context, widget);
    case "Valuator.Dial": return makeDial(context, widget);
    case "Valuator.Counter": return makeCounter(context, widget);
    case "Valuator.Input": return makeInput(context, widget);
    case "Button": return makeButton(context, widget);
    case "Button.Light": return makeLightButton(context, widget);
    case "Button.Choice": return makeChoice(context, widget);
    case "Text": return makeText(context, widget);
    case "Table": return makeTable(context, widget);
    case "Plot": return [...context.overlays.values()].flat().includes(widget) ? null : makePlotPanels(context, widget);
    case "Plot.3D": return makePlot3D(context, widget);
  }
}

function makeWindow(context: Context, widget: WindowWidget): Part {
  const parts: Part[] = [];
  // Cameras, plots and controls that follow each other belong together: where there is room, the first two take it.
  const runs: HTMLElement[] = [];
  for (const child of widget.children) {
    const part = makeWidget(context, child);
    if (part === null) continue;
    parts.push(part);
    const kind = hasCamera(child) ? "cameras" : hasPlot(child) ? "plots" : "controls";
    if (!runs.at(-1)?.classList.contains(kind)) runs.push(element("div", { class: `run ${kind}` }));
    runs.at(-1)!.append(part.element);
  }
  const frame = element("section", { class: "window", role: "group", "data-trail": widget.trail, "aria-label": widget.label || widget.trail },
    ...(widget.label === "" ? [] : [element("h2", {}, widget.label)]),
    element("div", { class: "window-body" }, ...runs));
  // Sizes of the file are least sizes: what there is more of a page, cameras and plots take rather than controls.
  frame.classList.add(hasCamera(widget) ? "with-camera" : hasPlot(widget) ? "wide" : "narrow");
  if (widget.width) frame.style.setProperty("--width", `${widget.width}px`);
  // As high as the file says, or higher where what it holds would not fit.
  if (widget.height) frame.style.setProperty("--height", `${widget.height}px`);
  return { element: frame, dispose: () => parts.forEach((part) => part.dispose()) };
}

/// Plots that are laid over others, by the trail of the one below, where that one is in the file.
export function overlaysOf(windows: Widget[]): Context["overlays"] {
  const plots: Extract<Widget, { type: "Plot" }>[] = [];
  const collect = (widgets: Widget[]) => {
    for (const widget of widgets) {
      if (widget.type === "Plot") plots.push(widget);
      if (widget.type === "Window") collect(widget.children);
    }
  };
  collect(windows);
  const overlays: Context["overlays"] = new Map();
  for (const plot of plots) {
    const below = plots.find((each) => each.trail === plot.overlay && each !== plot && !plots.some(({ trail }) => trail === each.overlay));
    if (below !== undefined) overlays.set(below.trail, [...(overlays.get(below.trail) ?? []), plot]);
  }
  return overlays;
}
