// What every part of the page works with: the description, the line to the program, values to
// watch and to set, and the present moment.
import type { Connection } from "./connection.ts";
import type { LayoutStore } from "./layout.ts";
import type { Changed, Description, PlotTrace, PlotWidget, Snapshot } from "./protocol.ts";
import type { Seeker } from "./seeker.ts";
import type { SharedTime } from "./shared_time.ts";
import type { SliderMarks } from "./slider_marks.ts";
import type { Setter, WatchedValues } from "./values.ts";

/// A part of the page that has been made. What it holds goes with `dispose`.
export interface Part {
  element: HTMLElement;
  dispose(): void;
}

export type Quality = "low" | "medium" | "high";

export interface Context {
  description: Description;
  connection: Connection;
  values: WatchedValues;
  setter: Setter;
  latest: Snapshot | null;
  /// Calls back for each snapshot that is drawn, at most once a frame of the screen; the answer ends it.
  onSnapshot(listener: (snapshot: Snapshot) => void): () => void;
  /// Tells when the run went on from an earlier moment: nothing after it holds any more.
  onBranch(listener: (time: number) => void): () => void;
  onTheme(listener: () => void): () => void;
  /// Tells what a user changed, in whatever browser.
  onChanged(listener: (changed: Changed) => void): () => void;
  /// The stretch that the plots show and the time under the pointer.
  time: SharedTime;
  seeker: Seeker;
  /// Where along sliders the step is unstable.
  marks: SliderMarks;
  layout: LayoutStore;
  /// How far long work has come, from 0 to 1.
  onProgress(listener: (work: string, done: number) => void): () => void;
  /// Tells when the page has the run begin anew: what a person arranged stays arranged.
  resets: Listeners<[]>;
  notice(level: "note" | "warning" | "error", text: string): void;

  quality: Quality;
  onQuality(listener: (quality: Quality) => void): () => void;
  exaggeration: number;
  onExaggeration(listener: (factor: number) => void): () => void;
  setExaggeration(factor: number): void;
  /// Which subjects are drawn, in the description's order.
  visible: boolean[];
  onVisible(listener: (subject: number, visible: boolean) => void): () => void;
  setVisible(subject: number, visible: boolean): void;
  /// The body that is selected, by its index, or null.
  selected: number | null;
  onSelected(listener: (body: number | null) => void): () => void;
  select(body: number | null): void;

  /// Plots laid over others, by the trail of the one below.
  overlays: Map<string, PlotWidget[]>;
  /// Shows a plot of a trail that the user chose.
  plot(trace: PlotTrace): void;
  /// Every camera's picture, by its trail.
  pictures: Map<string, () => Promise<Blob>>;
  /// Of every camera, the largest exaggeration at which all bodies are in its picture, by its trail.
  fits: Map<string, () => number>;
  /// What parts keep when the page is made anew for the same file: by trail.
  kept: Map<string, unknown>;
}

/// Listeners of one kind of event.
export class Listeners<Arguments extends unknown[]> {
  private readonly listeners = new Set<(...given: Arguments) => void>();
  readonly add = (listener: (...given: Arguments) => void): (() => void) => {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  };
  tell(...given: Arguments): void {
    for (const listener of this.listeners) listener(...given);
  }
}

/// Runs an action of the user and shows why where it was refused.
export function attempt(context: Context, action: Promise<unknown>): void {
  action.catch((refused: Error) => context.notice("error", refused.message));
}
