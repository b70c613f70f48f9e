// How the page is arranged for a file: what the file says, and what the user made of it, which the browser stores.
import { Listeners } from "./context.ts";
import type { Widget } from "./protocol.ts";

export interface Layout {
  share: number | null; // of the width, that the scenes take beside plots and controls
  side: number | null; // width of the panel at the side [CSS pixels]
  columns: number | null; // of plots; null: as many as have room
  heights: Record<string, number>; // of plots, by trail [CSS pixels]
  over: Record<string, boolean>; // whether a plot lies over a camera, by its trail, where the user chose
}

export const leastHeight = 60;
export const mostColumns = 3;
const sceneWidth = 480, tableWidth = 720, plotsWidth = 560, controlsWidth = 380; // where the file gives none [CSS pixels]
const leastShare = 0.25, mostShare = 0.75;

const positive = (value: unknown): number | null => (typeof value === "number" && value > 0 && value < Infinity ? value : null);

export function clampShare(share: number): number {
  return Math.min(mostShare, Math.max(leastShare, share));
}

/// What storage holds, as far as it makes sense.
export function parseLayout(text: string | null): Layout {
  let read: Partial<Record<keyof Layout, unknown>> | null = null;
  try {
    read = JSON.parse(text ?? "null");
  } catch {
    // Of another program of the same address.
  }
  const { share, side, columns, heights, over } = typeof read === "object" && read !== null ? read : {};
  const known = positive(share);
  const count = positive(columns);
  return {
    share: known === null ? null : clampShare(known),
    side: positive(side),
    columns: count === null ? null : Math.min(mostColumns, Math.round(count)),
    heights: Object.fromEntries(Object.entries(typeof heights === "object" && heights !== null ? heights : {})
      .flatMap(([trail, height]) => (positive(height) === null ? [] : [[trail, Math.max(leastHeight, height as number)]]))),
    over: Object.fromEntries(Object.entries(typeof over === "object" && over !== null ? over : {}).filter(([, lies]) => typeof lies === "boolean")) as Record<string, boolean>,
  };
}

export class LayoutStore {
  private readonly listeners = new Listeners<[]>();
  readonly onChange = this.listeners.add;
  private layout: Layout;

  constructor(private readonly key: string, private readonly storage: Pick<Storage, "getItem" | "setItem" | "removeItem">) {
    this.layout = parseLayout(this.stored(() => storage.getItem(key)) ?? null);
  }

  get now(): Readonly<Layout> {
    return this.layout;
  }
  change(part: Partial<Layout>): void {
    this.layout = { ...this.layout, ...part };
    this.stored(() => this.storage.setItem(this.key, JSON.stringify(this.layout)));
    this.listeners.tell();
  }
  /// As the file has it.
  reset(): void {
    this.layout = parseLayout(null);
    this.stored(() => this.storage.removeItem(this.key));
    this.listeners.tell();
  }

  /// Without storage, which a browser may refuse, a layout holds as long as the page.
  private stored<Answer>(act: () => Answer): Answer | undefined {
    try {
      return act();
    } catch {
      return undefined;
    }
  }
}

export function hasCamera(widget: Widget): boolean {
  return widget.type === "Window.grob" || (widget.type === "Window" && widget.children.some(hasCamera));
}
export function hasPlot(widget: Widget): boolean {
  return widget.type === "Plot" || widget.type === "Plot.3D" || (widget.type === "Window" && widget.children.some(hasPlot));
}

/// Width of a scene's window: what the file says, or what stands in it beside each other.
function widthOfScene(widget: Widget): number {
  if (widget.width) return widget.width;
  if (widget.type !== "Window") return widget.type === "Window.grob" ? sceneWidth : 0;
  return widget.children.reduce((sum, child) => sum + widthOfScene(child), 0);
}

/// The share of the page's width that scenes take beside the others: widths of the file count in proportion.
/// `subjects`: a table of subjects stands among the others.
export function shareOf(windows: Widget[], subjects: boolean): number {
  const across = widthOfScene(windows.find(hasCamera)!);
  return clampShare(across / (across + widthBeside(windows, subjects)));
}

function widthBeside(windows: Widget[], subjects: boolean): number {
  const others = windows.filter((each) => !hasCamera(each));
  return others.find((each) => each.width)?.width ?? (subjects ? tableWidth : others.some(hasPlot) ? plotsWidth : controlsWidth);
}

/// Fields of an object without a name cannot be set.
function isNamed(widget: Widget): boolean {
  return !widget.trail.replace(/#\d+$/, "").endsWith(widget.type);
}

export function camerasOf(widget: Widget): Widget[] {
  return widget.type === "Window" ? widget.children.flatMap(camerasOf) : widget.type === "Window.grob" ? [widget] : [];
}

export interface LayoutField {
  trail: string; // of an object
  field: "width" | "height" | "overlay";
  value: string;
}

/// Whether a plot lies over a camera: what the user chose, or else what the file says.
export function liesOver(layout: Layout, plot: { trail: string; over?: boolean }): boolean {
  return layout.over[plot.trail] ?? plot.over ?? false;
}

/// The fields that give this layout when they stand in the file.
export function fieldsFor(layout: Layout, windows: Widget[], subjects: boolean): LayoutField[] {
  const fields: LayoutField[] = [];
  const scene = windows.find(hasCamera);
  if (layout.share !== null && scene !== undefined) {
    const wider = (widthBeside(windows, subjects) * layout.share) / (1 - layout.share) - widthOfScene(scene);
    // A camera's width counts only in a window without one.
    const sized = isNamed(scene) ? scene : scene.width ? undefined : camerasOf(scene).find(isNamed);
    if (sized !== undefined) fields.push({ trail: sized.trail, field: "width", value: String(Math.max(1, Math.round(widthOfScene(sized) + wider))) });
  }
  const plotsOf = (widget: Widget): Widget[] => (widget.type === "Window" ? widget.children.flatMap(plotsOf) : hasPlot(widget) ? [widget] : []);
  for (const plot of windows.flatMap(plotsOf).filter(isNamed)) {
    const height = layout.heights[plot.trail];
    if (height !== undefined) fields.push({ trail: plot.trail, field: "height", value: String(Math.round(height)) });
    const camera = windows.flatMap(camerasOf).find(isNamed);
    if (camera !== undefined && plot.type === "Plot" && plot.overlay === null && layout.over[plot.trail] === true)
      fields.push({ trail: plot.trail, field: "overlay", value: camera.trail });
  }
  return fields;
}
