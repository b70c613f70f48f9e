// Where along sliders the run's step is unstable. The program is asked once a slider wants to know,
// and again after a change: another gain moves the marks.
import type { Connection } from "./connection.ts";
import type { Range, UnstableStretch } from "./protocol.ts";

const quiet = 300; // without a change before the program is asked again [ms]

export class SliderMarks {
  private readonly listeners = new Map<string, Set<(stretches: Range[]) => void>>();
  private stretches: UnstableStretch[] = [];
  private due = 0; // counts what wants an answer: an older one is no longer asked for

  constructor(
    private readonly connection: Pick<Connection, "request">,
    private readonly later: (act: () => void, wait: number) => void = (act, wait) => void setTimeout(act, wait),
  ) {}

  /// Calls back with the stretches of a slider's port, whenever they are others; the answer ends it.
  watch(port: string, listener: (stretches: Range[]) => void): () => void {
    const those = this.listeners.get(port) ?? new Set();
    this.listeners.set(port, those.add(listener));
    if (this.due === 0) this.ask(0);
    else listener(this.of(port));
    return () => those.delete(listener);
  }

  /// Something was changed in the run.
  changed(): void {
    if (this.due > 0) this.ask(quiet);
  }

  private of(port: string): Range[] {
    return this.stretches.filter((each) => each.port === port).map((each) => [each.from, each.to]);
  }

  private ask(wait: number): void {
    const due = ++this.due;
    this.later(() => {
      if (due !== this.due) return;
      this.connection.request("unstable", {}).then(({ unstable }) => {
        if (due !== this.due) return;
        this.stretches = unstable;
        for (const [port, those] of this.listeners) for (const listener of those) listener(this.of(port));
      }, () => {}); // the connection is lost: the next description requests them again
    }, wait);
  }
}

/// The ends of a stretch as shares of the way of a slider.
export function sharesOf([from, to]: Range, [least, greatest]: Range, placeOf: (value: number) => number): Range {
  const way = (value: number) => Math.min(1, Math.max(0, (placeOf(value) - placeOf(least)) / (placeOf(greatest) - placeOf(least))));
  return [way(from), way(to)];
}
