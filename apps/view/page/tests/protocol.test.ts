// Binary messages, written here number by number as docs/view_protocol.md has them.
import assert from "node:assert/strict";
import { test } from "node:test";
import { parseBinary, ProtocolError } from "../protocol.ts";

const message = (...numbers: number[]) => new Float64Array(numbers).buffer;
const head = [1, 3, 17, 250, 0.25, 1 + 2, 0.5, 0.49, 0.1, 0.3];

test("a snapshot of two subjects, one body and one contact", () => {
  const pose = [1, 2, 3, 1, 0, 0, 0];
  const contact = [0, 0.1, 0.2, 0.3, 4, 5, 6, 0.1, 0.2, 0.31, 0.001, -1];
  const parsed = parseBinary(message(...head, 2, 7.5, NaN, 2, 1, ...pose, 1, ...contact, 0, ...pose, 0), 1);
  assert.ok("snapshot" in parsed);
  const { snapshot } = parsed;
  assert.deepEqual([snapshot.layout, snapshot.frame, snapshot.step, snapshot.time], [3, 17, 250, 0.25]);
  assert.deepEqual([snapshot.paused, snapshot.past, snapshot.ended, snapshot.failed], [true, true, false, false]);
  assert.deepEqual([snapshot.speedAsked, snapshot.speedReached, snapshot.historyFirst, snapshot.historyLast], [0.5, 0.49, 0.1, 0.3]);
  assert.deepEqual([...snapshot.values], [7.5, NaN]);
  assert.deepEqual(snapshot.subjects.map((subject) => subject.fine), [true, false]);
  assert.deepEqual([...snapshot.subjects[1].poses], pose);
  assert.deepEqual([...snapshot.subjects[0].contacts], contact);
  assert.equal(snapshot.subjects[1].contacts.length, 0);
});

test("the flags of a run that ended and failed", () => {
  const parsed = parseBinary(message(...head.map((each, i) => (i === 5 ? 4 + 8 : each)), 0, 0), 5);
  assert.ok("snapshot" in parsed);
  const { paused, past, ended, failed } = parsed.snapshot;
  assert.deepEqual([paused, past, ended, failed], [false, false, true, true]);
});

test("a trace of two trails", () => {
  const parsed = parseBinary(message(2, 9, 2, 3, 0, 0.1, 0.2, 1, 2, 3, 4, 5, 6), 0);
  assert.ok("trace" in parsed);
  assert.equal(parsed.trace.id, 9);
  assert.deepEqual([...parsed.trace.times], [0, 0.1, 0.2]);
  assert.deepEqual(parsed.trace.values.map((each) => [...each]), [[1, 2, 3], [4, 5, 6]]);
});

test("what is not as the protocol has it is refused", () => {
  const wrong: [ArrayBuffer, RegExp][] = [
    [new ArrayBuffer(12), /12 bytes/],
    [message(), /ends early/],
    [message(3, 1), /kind 3/],
    [message(...head, 2, 7.5), /ends early/],
    [message(...head, 0, 1, 1, 0, 0), /ends early/],
    [message(...head, 0.5), /0.5 as the count of values/],
    [message(...head, -1), /-1 as the count/],
    [message(...head, NaN), /NaN as the count/],
    [message(...head, 0, 0, 4), /1 doubles after the end/],
    [message(2, 1, 1, 1e300), /ends early/],
  ];
  for (const [buffer, problem] of wrong)
    assert.throws(() => parseBinary(buffer, 1), (thrown) => thrown instanceof ProtocolError && problem.test(thrown.message));
});
