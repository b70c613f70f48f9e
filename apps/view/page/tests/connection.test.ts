// The page's line to the program, with the other end of the socket in the test's hand.
import assert from "node:assert/strict";
import { test } from "node:test";
import { addressOfSocket, Connection, Refused, type Socket } from "../connection.ts";
import type { Snapshot, Told } from "../protocol.ts";

class Line implements Socket {
  binaryType = "";
  onopen: ((event: never) => void) | null = null;
  onclose: ((event: never) => void) | null = null;
  onmessage: ((event: never) => void) | null = null;
  readyState = 0;
  sent: { id: number; do: string }[] = [];
  send(text: string) {
    this.sent.push(JSON.parse(text));
  }
  close() {
    this.readyState = 3;
    this.onclose?.(undefined as never);
  }
  open() {
    this.readyState = 1;
    this.onopen?.(undefined as never);
  }
  says(data: unknown) {
    this.onmessage?.({ data: data instanceof ArrayBuffer || typeof data === "string" ? data : JSON.stringify(data) } as never);
  }
}

function connect() {
  const waits: { act: () => void; wait: number }[] = [];
  const lines: Line[] = [];
  const heard = { told: [] as Told[], snapshots: [] as Snapshot[], connected: [] as boolean[], problems: [] as string[] };
  const connection = new Connection(() => lines[lines.push(new Line()) - 1], {
    told: (message) => heard.told.push(message),
    snapshot: (snapshot) => heard.snapshots.push(snapshot),
    connected: (yes) => heard.connected.push(yes),
    problem: (text) => heard.problems.push(text),
  }, (act, wait) => waits.push({ act, wait }));
  return { connection, lines, heard, waits };
}

test("answers find their requests in whatever order they come", async () => {
  const { connection, lines: [line] } = connect();
  line.open();
  const first = connection.request("read", { trails: ["a"] });
  const second = connection.request("patch", {});
  line.says({ id: line.sent[1].id, ok: true, name: "changes.hook", text: "" });
  line.says({ id: line.sent[0].id, ok: true, values: [{ trail: "a", value: 1, unit: "m" }] });
  assert.equal((await second).name, "changes.hook");
  assert.equal((await first).values[0].unit, "m");
});

test("a refusal rejects with the program's words", async () => {
  const { connection, lines: [line] } = connect();
  line.open();
  const set = connection.request("set", { values: { "pd1.gaol": 1 } });
  line.says({ id: line.sent[0].id, error: "no port pd1.gaol" });
  await assert.rejects(set, (thrown) => thrown instanceof Refused && String(thrown) === "Refused: no port pd1.gaol" && thrown.message === "no port pd1.gaol");
});

test("a trace is answered by its binary message, or by an error", async () => {
  const { connection, lines: [line] } = connect();
  line.open();
  line.says({ tell: "description", scene: { bodies: [] } });
  const trace = connection.request("trace", { trails: ["a"], from: 0, to: 1, points: 10 });
  const refused = connection.request("trace", { trails: ["b"], from: 0, to: 1, points: 10 });
  line.says({ id: line.sent[0].id, ok: true });
  line.says(new Float64Array([2, line.sent[0].id, 1, 2, 0, 1, 5, 6]).buffer);
  line.says({ id: line.sent[1].id, error: "no trail b" });
  assert.deepEqual([...(await trace).values[0]], [5, 6]);
  await assert.rejects(refused, /no trail b/);
});

test("no snapshot is read before there is a description, and a malformed message is told of", () => {
  const { lines: [line], heard } = connect();
  line.open();
  const snapshot = new Float64Array([1, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0]).buffer;
  line.says(snapshot);
  assert.equal(heard.snapshots.length, 0);
  line.says({ tell: "description", scene: { bodies: [] } });
  line.says(snapshot);
  assert.equal(heard.snapshots.length, 1);
  line.says(new Float64Array([7]).buffer);
  line.says("{");
  line.says({ error: "a message of 2 MiB" });
  assert.deepEqual(heard.problems, ["a binary message of kind 7", "a message that is no JSON", "a message of 2 MiB"]);
});

test("a line that breaks rejects what waits and is tried again, more and more patiently", async () => {
  const { connection, lines, heard, waits } = connect();
  const last = () => lines[lines.length - 1];
  last().open();
  const waiting = connection.request("pause", {});
  last().close();
  await assert.rejects(waiting, /lost/);
  await assert.rejects(connection.request("pause", {}), /no connection/);
  for (let tries = 0; tries < 6; ++tries) {
    waits[waits.length - 1].act();
    last().close();
  }
  waits[waits.length - 1].act();
  last().open();
  last().close();
  assert.deepEqual(waits.map((each) => each.wait), [250, 500, 1000, 2000, 4000, 4000, 4000, 250]);
  assert.deepEqual(heard.connected, [true, false, false, false, false, false, false, false, true, false]);
});

test("the socket stands beside the page, with the page's token", () => {
  assert.equal(addressOfSocket(new URL("http://127.0.0.1:8123/?token=a%20b")), "ws://127.0.0.1:8123/socket?token=a%20b");
});
