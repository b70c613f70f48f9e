// What happened in a run: changes by the user, bodies that touch, failure, end. The bar marks them.
import { numbersOfContact, type Snapshot } from "./protocol.ts";

export const eventNames = { change: "change", touch: "contact", failure: "failure", end: "end" } as const;
export type EventKind = keyof typeof eventNames;

export interface RunEvent {
  time: number; // [s]
  kind: EventKind;
  text: string;
}

const apart = 0.05; // without contact for this long, a body touches again [s]
const mostEvents = 5000;

export class RunEvents {
  readonly list: RunEvent[] = []; // in the order of time
  private readonly touched = new Map<number, number>(); // body: when it was last in contact
  private seen = -Infinity; // the latest time whose contacts are known

  constructor(private readonly nameOf: (body: number) => string) {}

  add(event: RunEvent): void {
    if (this.list.some((each) => each.time === event.time && each.text === event.text)) return;
    let at = this.list.length;
    while (at > 0 && this.list[at - 1].time > event.time) --at;
    this.list.splice(at, 0, event);
    if (this.list.length > mostEvents) this.list.shift();
  }

  /// Reads contacts, failure and end from a snapshot that is later than all before it.
  observe(snapshot: Snapshot): void {
    const { time } = snapshot;
    if (snapshot.failed) this.add({ time, kind: "failure", text: "the run failed" });
    else if (snapshot.ended) this.add({ time, kind: "end", text: "the run ended" });
    if (time <= this.seen) return;
    const previous = this.seen;
    this.seen = time;
    const contacts = snapshot.subjects[0]?.contacts ?? [];
    for (let at = 0; at < contacts.length; at += numbersOfContact) {
      const body = contacts[at];
      const before = this.touched.get(body) ?? -Infinity;
      if (before < previous && time - before > apart) this.add({ time, kind: "touch", text: `${this.nameOf(body)} touches` });
      this.touched.set(body, time);
    }
  }

  /// Forgets what lies after a time: the run went back and on from there.
  cutAfter(time: number): void {
    while (this.list.length > 0 && this.list[this.list.length - 1].time > time) this.list.pop();
    for (const [body, last] of this.touched) if (last > time) this.touched.delete(body);
    if (this.seen > time) this.seen = time;
  }
}

export interface Tick {
  x: number; // [pixels]
  kind: EventKind;
}

/// One tick a pixel and kind; what matters most is last, and so is drawn on top.
export function ticksOf(events: readonly RunEvent[], [first, last]: [number, number], width: number): Tick[] {
  const kinds: EventKind[] = ["touch", "change", "end", "failure"];
  return kinds.flatMap((kind) => {
    const places = new Set<number>();
    for (const event of events)
      if (event.kind === kind && event.time >= first && event.time <= last) places.add(Math.round(((event.time - first) / (last - first)) * width));
    return [...places].map((x) => ({ x, kind }));
  });
}

/// "2 changes, 1 failure".
export function summaryOf(events: readonly RunEvent[]): string {
  return (Object.keys(eventNames) as EventKind[])
    .map((kind) => ({ kind, count: events.filter((event) => event.kind === kind).length }))
    .filter(({ count }) => count > 0)
    .map(({ kind, count }) => `${count} ${eventNames[kind]}${count > 1 ? "s" : ""}`)
    .join(", ");
}
