// Values that widgets watch, and values that they set. What is watched is the union of all
// widgets' wishes, sent once when it changed; what is set is sent at most once a drawn frame.
import type { Connection } from "./connection.ts";
import type { Layout, Snapshot } from "./protocol.ts";

export type Watcher = (value: number, unit: string) => void;

export class WatchedValues {
  private watchers = new Map<string, Set<Watcher>>();
  private asked = "";
  private waiting = false;
  private layout = -1;
  private places = new Map<string, number>();
  private units: string[] = [];
  private latest: Float64Array | null = null;

  constructor(private readonly connection: () => Connection, private readonly problem: (text: string) => void) {}

  /// Calls back with each value that is drawn; the answer ends it.
  watch(trail: string, watcher: Watcher): () => void {
    const watchers = this.watchers.get(trail) ?? new Set();
    this.watchers.set(trail, watchers.add(watcher));
    const known = this.read(trail);
    if (known !== null) watcher(known.value, known.unit);
    this.ask();
    return () => {
      watchers.delete(watcher);
      if (watchers.size === 0 && this.watchers.get(trail) === watchers) this.watchers.delete(trail);
      this.ask();
    };
  }

  read(trail: string): { value: number; unit: string } | null {
    const place = this.places.get(trail);
    return place === undefined || this.latest === null || place >= this.latest.length
      ? null
      : { value: this.latest[place], unit: this.units[place] };
  }

  setLayout(layout: Layout): void {
    this.layout = layout.layout;
    this.places = new Map(layout.values.map((trail, place) => [trail, place]));
    this.units = layout.units;
    this.latest = null;
  }

  /// A new connection knows no wishes.
  askAnew(): void {
    this.asked = "";
    this.ask();
  }

  /// Tells the watchers what a snapshot holds. One of another layout holds other values.
  draw(snapshot: Snapshot): void {
    if (snapshot.layout !== this.layout) return;
    this.latest = snapshot.values;
    for (const [trail, watchers] of this.watchers) {
      const place = this.places.get(trail);
      if (place === undefined || place >= snapshot.values.length) continue;
      for (const watcher of watchers) watcher(snapshot.values[place], this.units[place]);
    }
  }

  private ask(): void {
    if (this.waiting) return;
    this.waiting = true;
    queueMicrotask(() => {
      this.waiting = false;
      const trails = [...this.watchers.keys()].sort();
      const wish = JSON.stringify(trails);
      if (wish === this.asked || !this.connection().connected) return;
      this.asked = wish;
      this.connection().request("watch", { trails }).catch((refused: Error) => this.problem(refused.message));
    });
  }
}

export class Setter {
  private values = new Map<string, number>();
  private answers: { resolve(): void; reject(problem: Error): void }[] = [];
  private frame = 0;

  constructor(private readonly connection: () => Connection) {}

  /// Sets a port with the next drawn frame; of several values of a port the last one counts.
  set(trail: string, value: number): Promise<void> {
    this.values.set(trail, value);
    if (this.frame === 0) this.frame = requestAnimationFrame(() => this.flush());
    return new Promise((resolve, reject) => this.answers.push({ resolve, reject }));
  }

  private flush(): void {
    this.frame = 0;
    const values = Object.fromEntries(this.values);
    const answers = this.answers;
    this.values.clear();
    this.answers = [];
    this.connection()
      .request("set", { values })
      .then(
        () => answers.forEach((each) => each.resolve()),
        (refused: Error) => answers.forEach((each) => each.reject(refused)),
      );
  }
}
