// What all plots over time share: the stretch that they show, and the time under the pointer.
import { Listeners } from "./context.ts";
import type { Range } from "./protocol.ts";

export class SharedTime {
  stretch: Range | null = null; // null: each plot shows what its file says
  pointed: number | null = null; // [s]
  private readonly changes = new Listeners<[]>();
  readonly onChange = this.changes.add;

  show(stretch: Range | null): void {
    if (this.stretch === null && stretch === null) return;
    this.stretch = stretch;
    this.changes.tell();
  }
  point(time: number | null): void {
    if (time === this.pointed) return;
    this.pointed = time;
    this.changes.tell();
  }
}

/// A stretch `factor` times as long that leaves `about` in its place; null where that is the whole.
export function zoomedAbout([begin, end]: Range, factor: number, about: number, [first, last]: Range, least: number): Range | null {
  const span = Math.max(factor * (end - begin), least);
  if (span >= last - first) return null;
  const part = (about - begin) / (end - begin);
  return within([about - part * span, about + (1 - part) * span], [first, last]);
}

/// A stretch of the same length, moved so that it lies within the whole.
export function within([begin, end]: Range, [first, last]: Range): Range {
  const by = begin < first ? first - begin : end > last ? last - end : 0;
  return [begin + by, end + by];
}
