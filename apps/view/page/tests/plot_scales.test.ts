import assert from "node:assert/strict";
import { test } from "node:test";
import { branchesOf } from "../trail_tree.ts";
import { decadeName, decadesWithin, padded, paddedByDecades, rangeOf } from "../widgets/plot_scales.ts";
import { niceTicks, project, surfaceOf } from "../widgets/plot3d_geometry.ts";

test("a range is of what is seen, and passes over what is not known", () => {
  assert.deepEqual(rangeOf([[1, NaN, 5], [-2, 0, 9]]), [-2, 9]);
  assert.deepEqual(rangeOf([[1, 2, 99]], [0, 1, 2], 0, 1), [1, 2]);
  assert.deepEqual(rangeOf([[]]), [0, 1]);
  const [least, greatest] = padded([3, 3]);
  assert.ok(least < 3 && greatest > 3);
});

test("ticks are round", () => {
  assert.deepEqual(niceTicks([0, 1]), [0, 0.2, 0.4, 0.6000000000000001, 0.8, 1]);
});

test("seen from above a box lies as on a map, from the side its height is upright", () => {
  const box: [[number, number], [number, number], [number, number]] = [[0, 1], [0, 1], [0, 1]];
  const above = { turn: 0, lift: Math.PI / 2 }, side = { turn: 0, lift: 0 };
  const middle = project(above, box, [0.5, 0.5, 0.5], 400, 300);
  const east = project(above, box, [1, 0.5, 0.5], 400, 300), north = project(above, box, [0.5, 1, 0.5], 400, 300);
  assert.ok(east.x > middle.x && Math.abs(east.y - middle.y) < 1e-9);
  assert.ok(north.y < middle.y && Math.abs(north.x - middle.x) < 1e-9);
  assert.ok(project(side, box, [0.5, 0.5, 1], 400, 300).y < project(side, box, [0.5, 0.5, 0], 400, 300).y);
  assert.ok(project(side, box, [0.5, 1, 0.5], 400, 300).depth > project(side, box, [0.5, 0, 0.5], 400, 300).depth);
});

test("a surface joins the samples of neighbouring cells and no others", () => {
  const xs: number[] = [], ys: number[] = [], zs: number[] = [];
  for (let i = 0; i < 24; ++i)
    for (let j = 0; j < 24; ++j) {
      if (i === 10 && j === 10) continue;
      xs.push((i + 0.5) / 24);
      ys.push((j + 0.5) / 24);
      zs.push(i + j);
    }
  const tiles = surfaceOf(xs, ys, zs, [0, 1], [0, 1]);
  assert.equal(tiles.length, 23 * 23 - 4);
  for (const [a, b, c, d] of tiles) assert.ok(Math.abs(a[2] - b[2] + c[2] - d[2]) < 1e-9);
});

test("trails become a tree by their parts", () => {
  const port = (trail: string) => ({ trail, unit: "", writable: false, minimum: null, maximum: null, doc: "" });
  const root = branchesOf([port("a.b.c"), port("a.b"), port("d")]);
  assert.deepEqual([...root.children.keys()], ["a", "d"]);
  const b = root.children.get("a")!.children.get("b")!;
  assert.equal(b.port?.trail, "a.b");
  assert.equal(b.children.get("c")?.port?.trail, "a.b.c");
});

test("a scale of both signs has 0 and powers of ten, few of them", () => {
  assert.deepEqual(decadesWithin(-2e-5, 3e-4, 1e-6).map((tick) => decadeName(tick, "")), ["\u22121e\u22125", "0", "1e\u22125", "1e\u22124"]);
  for (const greatest of [1e-5, 5e-3, 20, 1e6]) {
    const ticks = decadesWithin(-greatest, greatest, 1e-6);
    assert.ok(ticks.length >= 3 && ticks.length <= 9 && ticks.includes(0), `${ticks}`);
    for (const tick of ticks) assert.ok(Math.abs(tick) <= greatest * (1 + 1e-9));
  }
  const [least, greatest] = paddedByDecades([1e-5, 1e-3], 1e-6);
  assert.ok(least < 0 && least > -1e-6 && greatest > 1e-3 && greatest < 1e-2);
  assert.deepEqual([1e-6, -1e-5, 0, 0.01, 10000, 1e6].map((tick) => decadeName(tick, "")), ["1e\u22126", "\u22121e\u22125", "0", "0.01", "10000", "1e6"]);
  assert.deepEqual([1e-6, -1e-5, 1e-3, 0, 0.1, 1].map((tick) => decadeName(tick, "m")), ["1 \u00b5m", "\u221210 \u00b5m", "1 mm", "0", "0.1 m", "1 m"]);
});
