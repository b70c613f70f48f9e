// A recording: a movie that stands in the page itself. It answers as the program would (docs/view_protocol.md#recordings), so that the
// rest of the page does not know the difference.
import type { Socket } from "./connection.ts";
import { kindOfTrace, type Description, type Layout, type PortDescription } from "./protocol.ts";

export interface Recording {
  description: Description;
  layout: Layout;
  ports: { trail: string; unit: string; doc: string }[];
  instants: Float64Array[]; // snapshots, as the program sends them
}

// Of a snapshot, in doubles.
const number = 2, timeOf = 4, flags = 5, speedAsked = 6, speedReached = 7, historyFirst = 8, historyLast = 9, values = 11;
const pausedFlag = 1, pastFlag = 2;
const fastest = 1000; // what "as fast as possible" is here

function bytesOf(base64: string): Uint8Array {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let at = 0; at < text.length; ++at) bytes[at] = text.charCodeAt(at);
  return bytes;
}

/// The recording in `text`: five lines of base64.
export function readRecording(text: string): Recording {
  const [description, layout, rest, sizes, instants] = text.trim().split("\n").map(bytesOf);
  const json = (bytes: Uint8Array) => JSON.parse(new TextDecoder().decode(bytes));
  const recording: Recording = { description: json(description), layout: json(layout), ports: json(rest).ports, instants: [] };
  recording.description.recorded = true;
  let at = 0;
  for (const size of json(sizes) as number[]) {
    recording.instants.push(new Float64Array(instants.buffer.slice(at, at + size)));
    at += size;
  }
  return recording;
}

/// Whether `trail` fits: `*` stands for anything within a name, `**` for anything.
function fits(pattern: string, trail: string): boolean {
  const words = pattern.split(/(\*\*|\*)/).map((word) => (word === "**" ? ".*" : word === "*" ? "[^.]*" : word.replace(/[\\^$.+?()[\]{}|]/g, "\\$&")));
  return new RegExp(`^${words.join("")}$`).test(trail);
}

/// The end of the line at which a program would be.
export class RecordedSocket implements Socket {
  binaryType = "";
  onopen: ((event: never) => void) | null = null;
  onclose: ((event: never) => void) | null = null;
  onmessage: ((event: never) => void) | null = null;
  readyState = 0;

  private playing = true;
  private speed = 1;
  private at = 0; // index of the instant shown
  private sent = 0;
  private started = 0; // when playing began [ms]
  private startTime = 0; // and at what time [s]

  constructor(
    private readonly recording: Recording,
    private readonly now: () => number = () => performance.now(),
    private readonly eachFrame: (act: () => void) => void = (act) => void requestAnimationFrame(act),
  ) {
    queueMicrotask(() => {
      this.readyState = 1;
      this.onopen?.(undefined as never);
      this.say(recording.description);
      this.say(recording.layout);
      this.restart();
      this.show();
      this.turn();
    });
  }

  send(text: string): void {
    const request = JSON.parse(text) as { id: number; do: string } & Record<string, never>;
    queueMicrotask(() => this.carryOut(request));
  }

  private get first(): number {
    return this.recording.instants[0][timeOf];
  }
  private get last(): number {
    return this.recording.instants[this.recording.instants.length - 1][timeOf];
  }
  private get time(): number {
    return this.recording.instants[this.at][timeOf];
  }

  private say(message: object): void {
    this.onmessage?.({ data: JSON.stringify(message) } as never);
  }

  private carryOut(request: { id: number; do: string } & Record<string, unknown>): void {
    const answer = (members: object = {}) => this.say({ id: request.id, ok: true, ...members });
    switch (request.do) {
      case "pause": this.stop(); return answer();
      case "run":
        if (this.at === this.recording.instants.length - 1) this.at = 0;
        this.playing = true;
        this.restart();
        this.show();
        return answer();
      case "step": this.goTo(this.at + (request.count as number)); return answer();
      case "seek": this.goTo(this.nearest(request.time as number)); return answer();
      case "reset": this.goTo(0); return answer();
      case "speed":
        this.speed = request.factor as number;
        this.restart();
        this.show();
        return answer();
      case "watch": return answer();
      case "changes": return answer({ changes: [] });
      case "fields": return answer({ fields: [] });
      case "trails": return answer({ ports: this.fitting(request.pattern as string) });
      case "read": return this.read(request.id, request.trails as string[]);
      case "trace": return this.trace(request.id, request.trails as string[], request.from as number, request.to as number, request.points as number);
      default: return this.say({ id: request.id, error: "a recording is not changed: `hookpoint view` runs the file that it is of" });
    }
  }

  private fitting(pattern: string): PortDescription[] {
    const within = `${this.recording.description.world}.`; // a pattern may begin there
    const wanted = ({ trail }: { trail: string }) => fits(pattern, trail) || (trail.startsWith(within) && fits(pattern, trail.slice(within.length)));
    return this.recording.ports.filter(wanted).map((port) => ({ ...port, writable: false, minimum: null, maximum: null }));
  }

  private placeOf(trail: string): number {
    return this.recording.layout.values.indexOf(trail);
  }

  private read(id: number, trails: string[]): void {
    const unknown = trails.find((trail) => this.placeOf(trail) < 0);
    if (unknown !== undefined) return this.say({ id, error: `the recording has no values of \`${unknown}\`` });
    const now = this.recording.instants[this.at];
    const known = trails.map((trail) => ({ trail, value: now[values + this.placeOf(trail)], unit: this.recording.layout.units[this.placeOf(trail)] }));
    this.say({ id, ok: true, values: known });
  }

  private trace(id: number, trails: string[], from: number, to: number, points: number): void {
    const within = this.recording.instants.filter((instant) => instant[timeOf] >= from && instant[timeOf] <= to);
    const stride = Math.max(1, Math.ceil(within.length / points));
    const chosen = within.filter((_, index) => index % stride === 0);
    const columns = trails.map((trail) => {
      const place = this.placeOf(trail);
      return chosen.map((instant) => (place < 0 ? NaN : instant[values + place]));
    });
    const data = [kindOfTrace, id, trails.length, chosen.length, ...chosen.map((instant) => instant[timeOf]), ...columns.flat()];
    this.onmessage?.({ data: Float64Array.from(data).buffer } as never);
  }

  private nearest(time: number): number {
    let best = 0;
    this.recording.instants.forEach((instant, index) => {
      if (Math.abs(instant[timeOf] - time) < Math.abs(this.recording.instants[best][timeOf] - time)) best = index;
    });
    return best;
  }

  private goTo(index: number): void {
    this.at = Math.min(Math.max(index, 0), this.recording.instants.length - 1);
    this.stop();
  }

  private stop(): void {
    this.playing = false;
    this.show();
  }

  private restart(): void {
    this.started = this.now();
    this.startTime = this.time;
  }

  private turn(): void {
    if (this.playing) {
      const factor = this.speed === 0 ? fastest : this.speed;
      const due = this.startTime + (factor * (this.now() - this.started)) / 1000;
      const before = this.at;
      while (this.at + 1 < this.recording.instants.length && this.recording.instants[this.at + 1][timeOf] <= due) ++this.at;
      if (this.at === this.recording.instants.length - 1) this.stop();
      else if (this.at !== before) this.show();
    }
    this.eachFrame(() => this.turn());
  }

  /// The instant as it is, under the present state of the player.
  private show(): void {
    const snapshot = this.recording.instants[this.at].slice();
    snapshot[number] = ++this.sent;
    snapshot[flags] = (this.playing ? 0 : pausedFlag) | (this.at + 1 < this.recording.instants.length ? pastFlag : 0);
    snapshot[speedAsked] = this.speed;
    snapshot[speedReached] = this.playing ? this.speed : 0;
    snapshot[historyFirst] = this.first;
    snapshot[historyLast] = this.last;
    this.onmessage?.({ data: snapshot.buffer } as never);
  }
}
