// The pose of robots as sliders.
import assert from "node:assert/strict";
import { test } from "node:test";
import type { Body } from "../protocol.ts";
import { Starter, stateSliders } from "../state_editor.ts";

const body = (trail: string, more: object) => ({ trail, robot: 0, mass: 1, joint: null, start: [0, 0, 0.3, 1, 0, 0, 0], ...more }) as unknown as Body;
const robot = [
  body("w.dog.trunk", { parent: -1 }),
  body("w.dog.leg.hip", { parent: 0, joint: "revolute", limits: [-1, 2] }),
  body("w.dog.leg.rail", { parent: 1, joint: "prismatic", limits: [null, null] }),
];

/// Requests that the program takes, each answered when the test says so.
function program() {
  const taken: Record<string, number | number[]>[] = [];
  const answers: { resolve(): void; reject(problem: Error): void }[] = [];
  const connection = {
    request: (_name: string, { values }: { values: Record<string, number | number[]> }) => {
      taken.push(values);
      return new Promise<object>((resolve, reject) => answers.push({ resolve: () => resolve({}), reject }));
    },
  };
  return { taken, answers, starter: new Starter(connection as never) };
}
const later = () => new Promise((resolve) => setTimeout(resolve));

test("a slider has its joint's limits in degrees, and sets radians", async () => {
  const { starter, taken } = program();
  const values = { watch: (_trail: string, listener: (value: number) => void) => (listener(Math.PI / 2), () => {}), read: () => ({ value: 0, unit: "" }) };
  const sliders = stateSliders({ values } as never, starter, robot, 0);
  assert.deepEqual(sliders.map(({ label, unit }) => `${label} ${unit}`), ["x m", "y m", "z m", "roll deg", "pitch deg", "yaw deg", "leg.hip deg", "leg.rail m"]);
  const hip = sliders[6], rail = sliders[7];
  assert.deepEqual(hip.range.map((value) => Number(value.toFixed(6))), [-57.29578, 114.591559]);
  assert.deepEqual(rail.range, [-0.5, 0.5]);
  let shown = NaN;
  hip.line.watch((value) => (shown = value));
  assert.ok(Math.abs(shown - 90) < 1e-9);
  void hip.line.set(90);
  await later();
  assert.deepEqual(Object.keys(taken[0]), ["w.dog.leg.hip.angle"]);
  assert.ok(Math.abs((taken[0]["w.dog.leg.hip.angle"] as number) - Math.PI / 2) < 1e-12);
});

test("a turn of the base keeps its other two angles", async () => {
  const { starter, taken } = program();
  const [c, s] = [Math.cos(0.1), Math.sin(0.1)]; // rolled by 0.2
  const now: Record<string, number> = { w: c, x: s, y: 0, z: 0 };
  const values = { watch: () => () => {}, read: (trail: string) => ({ value: now[trail.at(-1)!], unit: "" }) };
  void stateSliders({ values } as never, starter, robot, 0)[5].line.set(90);
  await later();
  const [roll, pitch, yaw] = taken[0]["w.dog.trunk.orientation"] as number[];
  assert.ok(Math.abs(roll - 0.2) < 1e-12 && Math.abs(pitch) < 1e-12 && Math.abs(yaw - Math.PI / 2) < 1e-12);
});

test("while one request is under way the newest value of each port waits, and a refusal ends all", async () => {
  const { starter, taken, answers } = program();
  const done = starter.set("a", 1);
  await later();
  void starter.set("a", 2).catch(() => {});
  void starter.set("a", 3).catch(() => {});
  void starter.set("b", 4).catch(() => {});
  answers[0].resolve();
  await later();
  assert.deepEqual(taken, [{ a: 1 }, { a: 3, b: 4 }]);
  answers[1].reject(new Error("beyond the limit"));
  await assert.rejects(done, /beyond the limit/);
  void starter.set("a", 5);
  await later();
  assert.deepEqual(taken[2], { a: 5 });
});
