import assert from "node:assert/strict";
import { test } from "node:test";
import { SharedTime, within, zoomedAbout } from "../shared_time.ts";

test("zooming leaves the time under the pointer in its place", () => {
  const [begin, end] = zoomedAbout([0, 10], 0.5, 4, [0, 20], 0.01)!;
  assert.deepEqual([begin, end], [2, 7]);
  assert.equal((4 - begin) / (end - begin), 0.4);
});

test("zooming ends at the whole, at its edges and at the least stretch", () => {
  assert.equal(zoomedAbout([2, 18], 2, 10, [0, 20], 0.01), null);
  assert.deepEqual(zoomedAbout([0, 4], 2, 4, [0, 20], 0.01), [0, 8]);
  assert.deepEqual(zoomedAbout([16, 20], 2, 16, [0, 20], 0.01), [12, 20]);
  assert.deepEqual(zoomedAbout([9, 11], 1e-9, 10, [0, 20], 0.5), [9.75, 10.25]);
  assert.deepEqual(within([-1, 1], [0, 5]), [0, 2]);
  assert.deepEqual(within([4, 6], [0, 5]), [3, 5]);
});

test("all hear of a stretch and of a time once", () => {
  const time = new SharedTime();
  let told = 0;
  time.onChange(() => ++told);
  time.show(null);
  time.point(null);
  assert.equal(told, 0);
  time.show([1, 2]);
  time.point(1.5);
  time.point(1.5);
  time.show(null);
  assert.equal(told, 3);
});
