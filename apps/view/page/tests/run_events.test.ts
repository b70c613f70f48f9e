import assert from "node:assert/strict";
import { test } from "node:test";
import type { Snapshot } from "../protocol.ts";
import { RunEvents, summaryOf, ticksOf } from "../run_events.ts";

const at = (time: number, bodies: number[], more: Partial<Snapshot> = {}): Snapshot =>
  ({ time, failed: false, ended: false, ...more, subjects: [{ fine: true, poses: new Float64Array(), contacts: Float64Array.from(bodies.flatMap((body) => [body, ...Array(11).fill(0)])) }] }) as unknown as Snapshot;
const named = () => new RunEvents((body) => `leg${body}`);

test("a body that comes to the ground is an event, one that stands there or trembles is none", () => {
  const events = named();
  events.observe(at(0, [1]));
  events.observe(at(0.1, [1]));
  events.observe(at(0.11, [1, 2, 2]));
  events.observe(at(0.12, [1]));
  events.observe(at(0.13, [1, 2]));
  events.observe(at(0.3, [1]));
  events.observe(at(0.4, [1, 2]));
  assert.deepEqual(events.list.map(({ time, text }) => [time, text]), [[0.11, "leg2 touches"], [0.4, "leg2 touches"]]);
});

test("changes stand in the order of time, an end and a failure once", () => {
  const events = named();
  events.observe(at(0, []));
  events.add({ time: 2, kind: "change", text: "gain = 3" });
  events.add({ time: 1, kind: "change", text: "gain = 2" });
  events.add({ time: 1, kind: "change", text: "gain = 2" });
  for (let again = 0; again < 3; ++again) events.observe(at(3, [], { ended: true }));
  assert.deepEqual(events.list.map((each) => each.time), [1, 2, 3]);
  assert.equal(summaryOf(events.list), "2 changes, 1 end");
  events.observe(at(4, [], { ended: true, failed: true }));
  assert.equal(events.list[3].kind, "failure");
});

test("what lies after a branch is forgotten, and is told again when it comes again", () => {
  const events = named();
  for (const [time, bodies] of [[0, []], [1, [1]], [2, []], [3, [1]]] as [number, number[]][]) events.observe(at(time, bodies));
  events.cutAfter(1.5);
  assert.deepEqual(events.list.map((each) => each.time), [1]);
  events.observe(at(2.5, [1]));
  assert.deepEqual(events.list.map((each) => each.time), [1, 2.5]);
});

test("events of one pixel are one tick, failures on top", () => {
  const event = (time: number, kind: "touch" | "failure") => ({ time, kind, text: "" });
  const ticks = ticksOf([event(0, "touch"), event(0.001, "touch"), event(0.001, "failure"), event(1, "touch"), event(3, "touch")], [0, 2], 100);
  assert.deepEqual(ticks, [{ x: 0, kind: "touch" }, { x: 50, kind: "touch" }, { x: 0, kind: "failure" }]);
});
