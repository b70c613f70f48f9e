// Where sliders say that the step is unstable.
import assert from "node:assert/strict";
import { test } from "node:test";
import type { Range } from "../protocol.ts";
import { sharesOf, SliderMarks } from "../slider_marks.ts";

/// A program that answers when it is let, and a clock that runs when it is told.
function program() {
  const answers: ((unstable: { port: string; from: number; to: number }[]) => void)[] = [];
  const due: (() => void)[] = [];
  const connection = { request: () => new Promise((resolve) => answers.push((unstable) => resolve({ unstable }))) };
  const marks = new SliderMarks(connection as never, (act) => due.push(act));
  const run = () => due.splice(0).forEach((act) => act());
  const answer = async (...unstable: { port: string; from: number; to: number }[]) => {
    answers.shift()!(unstable);
    await Promise.resolve();
  };
  return { marks, run, answer, asked: () => answers.length };
}

test("all sliders share one request, and each hears of its own", async () => {
  const { marks, run, answer, asked } = program();
  const heard: Record<string, Range[]> = {};
  for (const port of ["p", "d"]) marks.watch(port, (stretches) => (heard[port] = stretches));
  run();
  assert.equal(asked(), 1);
  await answer({ port: "d", from: 1, to: 2 }, { port: "d", from: 3, to: 4 });
  assert.deepEqual(heard, { p: [], d: [[1, 2], [3, 4]] });
});

test("changes in quick order are one request, and an answer of before them is not shown", async () => {
  const { marks, run, answer, asked } = program();
  let heard: Range[] = [];
  marks.watch("d", (stretches) => (heard = stretches));
  run();
  marks.changed();
  marks.changed();
  run();
  assert.equal(asked(), 2); // the first, and one after the changes
  await answer({ port: "d", from: 1, to: 2 });
  assert.deepEqual(heard, []);
  await answer({ port: "d", from: 5, to: 6 });
  assert.deepEqual(heard, [[5, 6]]);
});

test("a stretch is placed by the slider's own scale", () => {
  assert.deepEqual(sharesOf([2, 3], [0, 4], (value) => value), [0.5, 0.75]);
  const [from, to] = sharesOf([10, 1000], [1, 10000], Math.log10);
  assert.ok(Math.abs(from - 0.25) < 1e-12 && Math.abs(to - 0.75) < 1e-12);
  assert.deepEqual(sharesOf([-1, 9], [0, 4], (value) => value), [0, 1]);
});
