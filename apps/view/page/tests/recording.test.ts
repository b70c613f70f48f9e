// A movie inside the page, played without a program: by the page's own connection, at a clock in the test's hand.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Connection, Refused } from "../connection.ts";
import { kindOfSnapshot, type Description, type Snapshot, type Told } from "../protocol.ts";
import { readRecording, RecordedSocket } from "../recording.ts";

/// An instant of one body with two values, one of them its number.
function instant(index: number): Float64Array {
  const time = index / 10;
  const body = [index, 0, 0, 1, 0, 0, 0];
  return Float64Array.from([kindOfSnapshot, 1, index + 1, 100 * index, time, 0, 1, 0, 0, 0, 2, index, -index, 1, 1, ...body, 0]);
}

function text(instants: Float64Array[]): string {
  const base64 = (bytes: Uint8Array) => Buffer.from(bytes).toString("base64");
  const json = (value: unknown) => base64(Buffer.from(JSON.stringify(value)));
  const description = { tell: "description", protocol: 1, kind: "movie", title: "a </script> in a name", world: "w", scene: { bodies: [{}] } };
  const layout = { tell: "layout", layout: 1, values: ["w.a.position.x", "w.a.position.z"], units: ["m", "m"] };
  const ports = layout.values.map((trail) => ({ trail, unit: "m", doc: "where it is" }));
  return `\n${[json(description), json(layout), json({ ports }), json(instants.map((each) => each.byteLength)),
    base64(Buffer.concat(instants.map((each) => Buffer.from(each.buffer))))].join("\n")}\n`;
}

async function play(count = 5) {
  const heard = { told: [] as Told[], snapshots: [] as Snapshot[], problems: [] as string[] };
  const clock = { now: 1000, turn: () => {} };
  const recording = readRecording(text(Array.from({ length: count }, (_, index) => instant(index))));
  const connection = new Connection(() => new RecordedSocket(recording, () => clock.now, (act) => (clock.turn = act)), {
    told: (message) => heard.told.push(message),
    snapshot: (snapshot) => heard.snapshots.push(snapshot),
    connected: () => {},
    problem: (problem) => heard.problems.push(problem),
  });
  await new Promise((resolve) => setImmediate(resolve));
  const pass = (milliseconds: number) => {
    clock.now += milliseconds;
    clock.turn();
  };
  const latest = () => heard.snapshots[heard.snapshots.length - 1];
  return { connection, heard, pass, latest };
}

test("it plays by the clock, stops at its end and begins again", async () => {
  const { connection, heard, pass, latest } = await play();
  assert.equal((heard.told[0] as Description).title, "a </script> in a name");
  assert.equal((heard.told[0] as Description).recorded, true);
  assert.deepEqual([latest().time, latest().paused, latest().past], [0, false, true]);
  assert.deepEqual([latest().historyFirst, latest().historyLast], [0, 0.4]);
  pass(210);
  assert.deepEqual([latest().time, latest().step, latest().values[0]], [0.2, 200, 2]);
  assert.equal(latest().subjects[0].poses[0], 2);
  await connection.request("speed", { factor: 0.1 });
  pass(900);
  assert.equal(latest().time, 0.2);
  pass(200);
  assert.deepEqual([latest().time, latest().speedReached], [0.3, 0.1]);
  await connection.request("speed", { factor: 0 });
  pass(1);
  assert.deepEqual([latest().time, latest().paused, latest().past], [0.4, true, false]);
  await connection.request("run", {});
  assert.deepEqual([latest().time, latest().paused], [0, false]);
  const numbers = heard.snapshots.map((snapshot) => snapshot.frame);
  assert.deepEqual(numbers, numbers.map((_, index) => index + 1));
  assert.deepEqual(heard.problems, []);
});

test("it goes where it is asked to and waits there", async () => {
  const { connection, pass, latest } = await play();
  await connection.request("seek", { time: 0.27 });
  assert.deepEqual([latest().time, latest().paused], [0.3, true]);
  pass(5000);
  assert.equal(latest().time, 0.3);
  await connection.request("step", { count: 9 });
  assert.equal(latest().time, 0.4);
  await connection.request("step", { count: -1 });
  assert.equal(latest().time, 0.3);
  await connection.request("reset", {});
  assert.equal(latest().time, 0);
  await connection.request("run", {});
  await connection.request("pause", {});
  pass(5000);
  assert.equal(latest().time, 0);
});

test("it is read, searched and plotted, and not changed", async () => {
  const { connection } = await play(11);
  await connection.request("seek", { time: 0.5 });
  assert.deepEqual((await connection.request("read", { trails: ["w.a.position.z"] })).values, [{ trail: "w.a.position.z", value: -5, unit: "m" }]);
  await assert.rejects(connection.request("read", { trails: ["w.a.mass"] }), /has no values of `w.a.mass`/);
  const names = async (pattern: string) => (await connection.request("trails", { pattern })).ports.map(({ trail }) => trail);
  assert.deepEqual(await names("**"), ["w.a.position.x", "w.a.position.z"]);
  assert.deepEqual(await names("a.position.*"), ["w.a.position.x", "w.a.position.z"]);
  assert.deepEqual([await names("w.*"), await names("position.x")], [[], []]);
  assert.deepEqual(await names("w.a.position.z"), ["w.a.position.z"]);
  const all = await connection.request("trace", { trails: ["w.a.position.x", "w.b"], from: 0.15, to: 0.55, points: 100 });
  assert.deepEqual([...all.times], [0.2, 0.3, 0.4, 0.5]);
  assert.deepEqual([...all.values[0]], [2, 3, 4, 5]);
  assert.ok(all.values[1].every(Number.isNaN));
  const few = await connection.request("trace", { trails: ["w.a.position.x"], from: 0, to: 1, points: 4 });
  assert.ok(few.times.length <= 4 && few.times[0] === 0);
  for (const change of [connection.request("set", { values: { "w.a.position.x": 1 } }), connection.request("edit", { trail: "w.a", value: "1" })])
    await assert.rejects(change, Refused);
});
