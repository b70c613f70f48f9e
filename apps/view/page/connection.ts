// The page's line to the program: requests with their answers, what the program tells, snapshots
// and traces. Where the line breaks it tries again, for as long as the page is open.
import { parseBinary, ProtocolError } from "./protocol.ts";
import type { RequestName, Requests, Snapshot, Told, Trace } from "./protocol.ts";

export interface Listeners {
  told(message: Told): void;
  snapshot(snapshot: Snapshot): void;
  connected(yes: boolean): void;
  problem(text: string): void;
}

/// What of a WebSocket is used, so that a test can hold the other end.
export interface Socket {
  binaryType: string;
  onopen: ((event: never) => void) | null;
  onclose: ((event: never) => void) | null;
  onmessage: ((event: never) => void) | null;
  readyState: number;
  send(text: string): void;
}

interface Pending {
  trace: boolean;
  resolve(answer: never): void;
  reject(problem: Error): void;
}

const open = 1;
const firstWait = 250; // ms
const longestWait = 4000;

/// The answer to a request that the program refused. What people read of it has no name of a class, which a bundle shortens.
export class Refused extends Error {
  override readonly name = "Refused";
}

export class Connection {
  private socket: Socket | null = null;
  private pending = new Map<number, Pending>();
  private lastId = 0;
  private wait = firstWait;
  private bodies: number | null = null; // of the description; before it no snapshot can be read

  constructor(
    private readonly makeSocket: () => Socket,
    private readonly listeners: Listeners,
    private readonly later: (act: () => void, wait: number) => void = (act, wait) => void setTimeout(act, wait),
  ) {
    this.connect();
  }

  get connected(): boolean {
    return this.socket !== null && this.socket.readyState === open;
  }

  request<Name extends RequestName>(name: Name, fields: Requests[Name]["with"]): Promise<Requests[Name]["answer"]> {
    return new Promise((resolve, reject) => {
      if (this.socket === null || !this.connected) {
        reject(new Refused("there is no connection to the program"));
        return;
      }
      const id = ++this.lastId;
      this.pending.set(id, { trace: name === "trace", resolve, reject });
      this.socket.send(JSON.stringify({ id, do: name, ...fields }));
    });
  }

  private connect(): void {
    const socket = this.makeSocket();
    this.socket = socket;
    this.bodies = null;
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.wait = firstWait;
      this.listeners.connected(true);
    };
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => {
      try {
        if (typeof event.data === "string") this.receiveText(event.data);
        else this.receiveBinary(event.data);
      } catch (problem) {
        if (!(problem instanceof ProtocolError)) throw problem;
        this.listeners.problem(problem.message);
      }
    };
    socket.onclose = () => {
      this.socket = null;
      const lost = [...this.pending.values()];
      this.pending.clear();
      for (const each of lost) each.reject(new Refused("the connection to the program was lost"));
      this.listeners.connected(false);
      this.later(() => this.connect(), this.wait);
      this.wait = Math.min(longestWait, 2 * this.wait);
    };
  }

  private receiveText(text: string): void {
    let message: { tell?: string; id?: number; ok?: boolean; error?: string };
    try {
      message = JSON.parse(text);
    } catch {
      throw new ProtocolError("a message that is no JSON");
    }
    if (typeof message.tell === "string") {
      const told = message as Told;
      if (told.tell === "description") this.bodies = told.kind === "study" ? 0 : told.scene.bodies.length;
      this.listeners.told(told);
      return;
    }
    const pending = message.id === undefined ? undefined : this.pending.get(message.id);
    if (pending === undefined) {
      if (typeof message.error === "string") this.listeners.problem(message.error);
      return;
    }
    if (typeof message.error === "string") {
      this.pending.delete(message.id!);
      pending.reject(new Refused(message.error));
    } else if (!pending.trace) {
      this.pending.delete(message.id!);
      pending.resolve(message as never);
    }
  }

  private receiveBinary(buffer: ArrayBuffer): void {
    if (this.bodies === null) return;
    const message = parseBinary(buffer, this.bodies);
    if ("snapshot" in message) {
      this.listeners.snapshot(message.snapshot);
      return;
    }
    const pending = this.pending.get(message.trace.id);
    this.pending.delete(message.trace.id);
    pending?.resolve(message.trace as Trace as never);
  }
}

/// Where the page's program listens: beside the page, with the token that the page was opened with.
export function addressOfSocket(page: URL | Location): string {
  const protocol = page.protocol === "https:" ? "wss:" : "ws:";
  const token = new URLSearchParams(page.search).get("token") ?? "";
  return `${protocol}//${page.host}/socket?token=${encodeURIComponent(token)}`;
}
