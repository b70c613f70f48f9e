// What a plot keeps of a run.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Branches, csvOf, keptByExtremes, Series, instantAt } from "../series.ts";

test("what is known already is passed over", () => {
  const series = new Series(1);
  series.append([0, 1, 2], [[5, 6, 7]]);
  series.append([1, 2, 3], [[60, 70, 8]]);
  assert.deepEqual(series.times, [0, 1, 2, 3]);
  assert.deepEqual(series.columns, [[5, 6, 7, 8]]);
});

test("a run that went back and on loses what came after", () => {
  const series = new Series(2);
  series.append([0, 1, 2, 3], [[0, 1, 2, 3], [0, 10, 20, 30]]);
  series.cutAfter(1);
  series.append([1.5, 2], [[7, 8], [9, 10]]);
  assert.deepEqual(series.times, [0, 1, 1.5, 2]);
  assert.deepEqual(series.columns, [[0, 1, 7, 8], [0, 10, 9, 10]]);
});

test("memory is bounded and no peak is lost", () => {
  const limit = 1000, count = 100_000, up = 31_234, down = 77_777;
  const series = new Series(2, limit);
  for (let begin = 0; begin < count; begin += 500) {
    const times = Array.from({ length: 500 }, (_, i) => begin + i);
    series.append(times, [times.map((t) => (t === up ? 9 : Math.sin(t))), times.map((t) => (t === down ? -9 : Math.cos(t)))]);
    assert.ok(series.length <= limit);
  }
  assert.equal(series.columns[0][series.times.indexOf(up)], 9);
  assert.equal(series.columns[1][series.times.indexOf(down)], -9);
  assert.equal(series.times[0], 0);
  assert.equal(series.last, count - 1);
  assert.ok(series.times.every((time, i) => i === 0 || time > series.times[i - 1]));
});

test("values that are not known do not hide those that are", () => {
  const column = Array.from({ length: 100 }, (_, i) => (i === 40 ? 3 : NaN));
  const kept = keptByExtremes([column], 100, 10);
  assert.ok(kept.includes(40));
  assert.ok(kept.length <= 12);
});

test("a branch is where the run went on from, not where the page saw it next", () => {
  const branches = new Branches();
  const seen = [[1, false], [2, false], [0.5, true], [0.7, true], [0.8, false], [0.9, false]] as const;
  assert.deepEqual(seen.map(([time, past]) => branches.observe(time, past)), [null, null, null, null, 0.7, null]);
});

test("looking at the past and coming back to the present cuts nothing, a reset all", () => {
  const branches = new Branches();
  const seen = [[2, false], [0.5, true], [2, false], [3, false], [0, false]] as const;
  assert.deepEqual(seen.map(([time, past]) => branches.observe(time, past)), [null, null, null, null, 0]);
});

test("CSV holds numbers in full, nothing for what is not known, and quotes where it must", () => {
  assert.equal(csvOf(["time [s]", 'a,"b"'], [[0, 0.1], [1 / 3, NaN]]), 'time [s],"a,""b"""\n0,0.3333333333333333\n0.1,\n');
});

test("the instant that is shown is the last one up to it", () => {
  const times = [0, 0.1, 0.2, 0.3];
  for (const [time, instant] of [[-1, -1], [0, 0], [0.15, 1], [0.3, 3], [9, 3]]) assert.equal(instantAt(times, time), instant);
  assert.equal(instantAt([], 1), -1);
});
