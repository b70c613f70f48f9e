// The page of a run or a movie: the bar, the file's windows or what stands for them, plots that the
// user chose, creep, and the side panel.
import { listenForKeys, makeHelp } from "./keys.ts";
import { Listeners, type Context, type Part } from "./context.ts";
import { makeCreepPanel } from "./creep_panel.ts";
import { element } from "./dom.ts";
import { iconButton } from "./icons.ts";
import { clampShare, hasCamera, shareOf } from "./layout.ts";
import type { CameraWidget, PlotTrace } from "./protocol.ts";
import { makeResizeHandle } from "./resize_handle.ts";
import { makeSidePanel } from "./side_panel.ts";
import { toggleTheme } from "./theme.ts";
import { makeTransport } from "./transport.ts";
import { makePlot } from "./widgets/plot.ts";
import { makeWidget } from "./widgets/window.ts";

/// A file that says nothing of windows is shown by one camera, whose place no port holds.
export function ownCamera(context: Context): CameraWidget {
  return {
    type: "Window.grob", trail: "camera", label: context.description.world, drawer: context.description.world, follow: null, accompany: true,
    ports: { zoom: "", distance: "", euler1: "", euler2: "" }, show: {},
  };
}

export function makeRunPage(context: Context, themeChanged: Listeners<[]>): Part {
  const { description } = context;
  const bare = description.windows.length === 0;
  const desk = element("main", { class: bare ? "desk bare" : "desk" });
  const parts: Part[] = [];
  // Where there are scenes and other things, scenes stay in sight while the others are scrolled.
  const scenes = element("div", { class: "column scenes" }), others = element("div", { class: "column others" });
  const split = !bare && description.windows.some(hasCamera) && (description.subjects.length > 1 || !description.windows.every(hasCamera));
  if (split) {
    desk.classList.add("split");
    const width = () => scenes.offsetWidth + others.offsetWidth;
    desk.append(scenes, makeResizeHandle({
      label: "width of the scene", along: "x", size: () => scenes.offsetWidth,
      resize: (size) => context.layout.change({ share: clampShare(size / width()) }), restore: () => context.layout.change({ share: null }),
    }), others);
  }
  const arrange = () => {
    const { share, columns } = context.layout.now;
    if (split) desk.style.setProperty("--share", String(share ?? shareOf(description.windows, description.subjects.length > 1)));
    desk.classList.toggle("in-columns", columns !== null);
    desk.style.setProperty("--columns", String(columns ?? 1));
  };
  arrange();
  const forgetLayout = context.layout.onChange(arrange);
  const add = (part: Part | null, scene = false) => {
    if (part === null) return;
    parts.push(part);
    (split ? (scene ? scenes : others) : desk).append(part.element);
  };
  const [first, ...further] = bare ? [ownCamera(context)] : description.windows;
  add(makeWidget(context, first), hasCamera(first));
  // Beside or below the scene that it measures.
  if (description.subjects.length > 1) add(makeCreepPanel(context));
  for (const widget of further) add(makeWidget(context, widget), hasCamera(widget));

  // Plots of trails that the user chose, kept when the page is made anew.
  const chosen = (context.kept.get("plots") as PlotTrace[] | undefined) ?? [];
  context.kept.set("plots", chosen);
  const plots = new Map<PlotTrace, Part>();
  const addPlot = (trace: PlotTrace) => {
    const plot = makePlot(context, { type: "Plot", trail: `plot of ${trace.y}`, label: trace.label, traces: [trace], range: null, x_range: null, window: null, overlay: null });
    plot.element.classList.add("chosen");
    plot.element.querySelector("figcaption")?.append(iconButton("close", `close the plot of ${trace.y}`, () => {
      plot.dispose();
      plot.element.remove();
      plots.delete(trace);
      chosen.splice(chosen.indexOf(trace), 1);
    }));
    plots.set(trace, plot);
    (split ? others : desk).append(plot.element);
    return plot;
  };
  chosen.forEach(addPlot);
  context.plot = (trace) => {
    const there = [...plots].find(([each]) => each.y === trace.y);
    if (there === undefined) chosen.push(trace);
    const plot = there === undefined ? addPlot(trace) : there[1];
    plot.element.scrollIntoView({ block: "nearest" });
  };

  const work = element("div", { class: "work" }, desk);
  let side: ReturnType<typeof makeSidePanel> | null = null;
  const openSide = (open: boolean, shown = false) => {
    context.kept.set("sideOpen", open);
    if (open === (side !== null)) return;
    if (side === null) {
      work.append((side = makeSidePanel(context, () => openSide(false))).element);
      if (shown) side.element.scrollIntoView({ block: "nearest" });
    }
    else {
      side.dispose();
      side.element.remove();
      side = null;
    }
  };
  const roomy = matchMedia("(min-width: 900px)").matches;
  openSide((context.kept.get("sideOpen") as boolean | undefined) ?? (bare && roomy));
  const forgetSelected = context.onSelected((body) => {
    if (body === null) return;
    openSide(true, true);
    side?.show("body");
  });

  const help = makeHelp(description.version);
  const toggleSide = () => openSide(side === null, true);
  const transport = makeTransport(context, {
    theme: () => {
      toggleTheme();
      themeChanged.tell();
    },
    help: () => (help.open ? help.close() : help.showModal()),
    openSide: toggleSide,
  });
  const forgetKeys = listenForKeys(context, transport.actions, toggleSide);
  return {
    element: element("div", { class: "page" }, transport.element, work, help),
    dispose: () => {
      forgetKeys();
      forgetLayout();
      forgetSelected();
      side?.dispose();
      transport.dispose();
      [...parts, ...plots.values()].forEach((part) => part.dispose());
    },
  };
}
