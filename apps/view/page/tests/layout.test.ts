import assert from "node:assert/strict";
import { test } from "node:test";
import { fieldsFor, LayoutStore, liesOver, parseLayout, shareOf } from "../layout.ts";
import type { Widget } from "../protocol.ts";

const camera = (width: number | null) => ({ type: "Window.grob", trail: "eye", label: "", width }) as unknown as Widget;
const frame = (trail: string, width: number | null, ...children: Widget[]) => ({ type: "Window", trail, label: "", width, height: null, children }) as Widget;
const plot = (trail: string) => ({ type: "Plot", trail, label: "", overlay: null }) as unknown as Widget;
const slider = { type: "Valuator.Slider", trail: "s", label: "" } as unknown as Widget;
const nothing = parseLayout(null);

test("what storage holds is read as far as it makes sense", () => {
  assert.deepEqual(nothing, { share: null, side: null, columns: null, heights: {}, over: {} });
  for (const text of ["", "{", "[]", "7", '{"share":-1,"side":"wide","columns":0,"heights":[]}']) assert.deepEqual(parseLayout(text), nothing, text);
  assert.deepEqual(parseLayout('{"share":0.99,"side":500,"columns":9,"heights":{"a":300,"b":-1,"c":1},"over":{"a":true,"b":3}}'),
    { share: 0.75, side: 500, columns: 3, heights: { a: 300, c: 60 }, over: { a: true } });
});

test("a layout is stored, told and forgotten; without storage it holds as long as the page", () => {
  const held = new Map<string, string>();
  const storage = { getItem: (key: string) => held.get(key) ?? null, setItem: (key: string, value: string) => void held.set(key, value), removeItem: (key: string) => void held.delete(key) };
  let told = 0;
  const store = new LayoutStore("k", storage);
  store.onChange(() => ++told);
  store.change({ share: 0.5 });
  assert.equal(new LayoutStore("k", storage).now.share, 0.5);
  assert.equal(new LayoutStore("other", storage).now.share, null);
  store.reset();
  assert.equal(held.size, 0);
  assert.equal(told, 2);
  const refuse = () => { throw new Error("refused"); };
  const homeless = new LayoutStore("k", { getItem: refuse, setItem: refuse, removeItem: refuse });
  homeless.change({ columns: 2 });
  assert.equal(homeless.now.columns, 2);
});

test("widths of the file count in proportion; without them neither side is squeezed", () => {
  assert.equal(shareOf([frame("a", 600, camera(null)), frame("b", 400, plot("b.p"))], false), 0.6);
  assert.equal(shareOf([frame("a", 900, camera(null)), frame("b", 100, slider)], false), 0.75);
  assert.equal(shareOf([frame("a", null, camera(100)), frame("b", null, plot("b.p"))], false), 0.25);
  assert.equal(shareOf([frame("a", null, camera(330), frame("a.c", 240, slider)), frame("b", null, slider)], false), 0.6);
  assert.equal(shareOf([camera(560), frame("b", null, plot("b.p"))], false), 0.5);
});

test("the fields for the file give the same layout again", () => {
  const layout = { ...nothing, share: 0.7, heights: { "b.c.q": 310.4, "overview.Speed": 90, "Plot#2": 90 } };
  const beside = frame("b", 400, plot("b.p"), plot("Plot#2"), frame("b.c", null, plot("b.c.q")));
  const named = (width: number | null) => [frame("a", width, camera(300)), beside];
  const unnamed = (width: number) => [frame("Window", null, camera(width), frame("Window#2", 200, slider)), beside];
  const sizes = fieldsFor(layout, named(null), false);
  assert.deepEqual(sizes.map(({ trail, field }) => `${trail}.${field}`), ["a.width", "b.c.q.height"]);
  assert.equal(sizes[1].value, "310");
  assert.ok(Math.abs(shareOf(named(Number(sizes[0].value)), false) - 0.7) < 1e-3);
  const [eye] = fieldsFor(layout, unnamed(100), false);
  assert.equal(`${eye.trail}.${eye.field}`, "eye.width");
  assert.ok(Math.abs(shareOf(unnamed(Number(eye.value)), false) - 0.7) < 1e-3);
  assert.deepEqual(fieldsFor({ ...layout, heights: {} }, [frame("Window", 500, camera(300)), beside], false), []);
  assert.deepEqual(fieldsFor(nothing, named(1), false), []);
});

test("a plot lies over a camera where the user or else the file says so, and the file can say it", () => {
  assert.equal(liesOver(nothing, { trail: "b.p", over: true }), true);
  assert.equal(liesOver({ ...nothing, over: { "b.p": false } }, { trail: "b.p", over: true }), false);
  assert.equal(liesOver({ ...nothing, over: { "b.p": true } }, { trail: "b.p" }), true);
  const windows = [frame("a", null, camera(300)), frame("b", null, plot("b.p"), plot("b.q"))];
  const fields = fieldsFor({ ...nothing, over: { "b.p": true, "b.q": false } }, windows, false);
  assert.deepEqual(fields, [{ trail: "b.p", field: "overlay", value: "eye" }]);
});
