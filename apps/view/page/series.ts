// What a plot holds of a run: times that rise and the values of its trails at them. Of a long run
// it keeps each stretch's least and greatest values, so that memory stays bounded and no peak is lost.

export class Series {
  times: number[] = [];
  columns: number[][];

  constructor(trails: number, private readonly limit = 40_000) {
    this.columns = Array.from({ length: trails }, () => []);
  }

  get length(): number {
    return this.times.length;
  }
  get last(): number {
    return this.times.length > 0 ? this.times[this.times.length - 1] : -Infinity;
  }

  /// Adds what comes after the last instant; what is known already is passed over.
  append(times: ArrayLike<number>, values: ArrayLike<number>[]): void {
    for (let i = 0; i < times.length; ++i) {
      if (!(times[i] > this.last)) continue;
      this.times.push(times[i]);
      this.columns.forEach((column, trail) => column.push(values[trail][i]));
    }
    if (this.length > this.limit) this.decimate();
  }

  /// Forgets what lies after an instant: the run went back and on from there.
  cutAfter(time: number): void {
    let count = this.length;
    while (count > 0 && this.times[count - 1] > time) --count;
    this.times.length = count;
    for (const column of this.columns) column.length = count;
  }

  clear(): void {
    this.cutAfter(-Infinity);
  }

  private decimate(): void {
    const kept = keptByExtremes(this.columns, this.length, Math.floor(this.limit / 2));
    this.times = kept.map((i) => this.times[i]);
    this.columns = this.columns.map((column) => kept.map((i) => column[i]));
  }
}

/// The instants that stay of `count` so that at most about `target` do: the first, the last, and of
/// each stretch those at which a column has its least and its greatest value.
export function keptByExtremes(columns: ArrayLike<number>[], count: number, target: number): number[] {
  if (count <= target || columns.length === 0) return Array.from({ length: count }, (_, i) => i);
  const stretches = Math.max(1, Math.floor(target / (2 * columns.length)));
  const kept = new Set<number>([0, count - 1]);
  for (let stretch = 0; stretch < stretches; ++stretch) {
    const begin = Math.floor((stretch * count) / stretches);
    const end = Math.floor(((stretch + 1) * count) / stretches);
    for (const column of columns) {
      let least = -1, greatest = -1;
      for (let i = begin; i < end; ++i) {
        if (Number.isNaN(column[i])) continue;
        if (least < 0 || column[i] < column[least]) least = i;
        if (greatest < 0 || column[i] > column[greatest]) greatest = i;
      }
      if (least >= 0) kept.add(least).add(greatest);
    }
  }
  return [...kept].sort((a, b) => a - b);
}

/// The last of rising times that is not after `time`, or -1.
export function instantAt(times: ArrayLike<number>, time: number): number {
  let [before, after] = [-1, times.length];
  while (after - before > 1) {
    const middle = (before + after) >> 1;
    if (times[middle] <= time) before = middle;
    else after = middle;
  }
  return before;
}

/// Follows the time of the snapshots and tells when the run went on from an earlier moment.
export class Branches {
  private live = -Infinity; // the latest moment that was not of the past
  private shown: number | null = null; // the moment of the past that is being shown

  /// The instant after which nothing that was recorded holds any more, or null.
  observe(time: number, past: boolean): number | null {
    if (past) {
      this.shown = time;
      return null;
    }
    let branch: number | null = null;
    if (this.shown !== null && this.shown < this.live && time < this.live) branch = Math.min(this.shown, time);
    else if (time < this.live) branch = time;
    this.shown = null;
    this.live = time;
    return branch;
  }
}

/// A table of columns as CSV, numbers in full.
export function csvOf(header: string[], columns: ArrayLike<number>[]): string {
  const quoted = (text: string) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
  const lines = [header.map(quoted).join(",")];
  const count = columns.length > 0 ? columns[0].length : 0;
  for (let i = 0; i < count; ++i)
    lines.push(columns.map((column) => (Number.isNaN(column[i]) ? "" : String(column[i]))).join(","));
  return lines.join("\n") + "\n";
}
