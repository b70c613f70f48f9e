// What is drawn of a snapshot: contacts with their exaggerated bodies, traces of what slid.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Vector3 } from "three";
import type { Description, Snapshot } from "../protocol.ts";
import { Stage } from "../scene/stage.ts";
import { SlipPlaces } from "../scene/traces.ts";

function near(actual: number, expected: number, tolerance = 1e-9): void {
  assert.ok(Math.abs(actual - expected) <= tolerance, `${actual} is not ${expected}`);
}
/// Two robots of 1 and 2 kg: a cube of 0.2 m each, under 10 m/s^2.
function description(start?: number[], obstacles = 0): Description {
  const body = (robot: number, mass: number) => ({
    trail: `world.robot${robot}.base`, robot, parent: -1, mass, center_of_mass: [0, 0, 0], inertia: [1, 1, 1, 0, 0, 0], joint: null,
    shapes: [{ kind: "box", dimensions: [0.2, 0.2, 0.2], location: [0, 0, 0], orientation: [1, 0, 0, 0] }], points: [],
    ...(start ? { start } : {}),
  });
  return {
    scene: { bodies: [body(0, 1), body(1, 2), ...Array.from({ length: obstacles }, () => body(-1, 0))], terrain: null, materials: [], gravity: [0, 0, -10], sensors: [] },
    subjects: [{ name: "hookpoint", colour: "#0072B2" }],
  } as unknown as Description;
}
function snapshot(step: number, x: number, sliding = 0): Snapshot {
  const pose = (y: number) => [x, y, 0.1, 1, 0, 0, 0];
  return {
    step, time: step * 0.001, past: false,
    subjects: [{
      fine: true,
      poses: new Float64Array([...pose(0), ...pose(1)]),
      contacts: new Float64Array([0, x + 0.1, 0.1, 0, 0, 0, 10, x, 0.1, 0, 1e-4, sliding]),
    }],
  } as unknown as Snapshot;
}
function drawn(stage: Stage, shown: Snapshot): Stage {
  stage.take(shown);
  stage.pose();
  return stage;
}

test("one body weight is that of the heaviest robot", () => {
  near(new Stage(description(), null).weight, 20);
});

test("the robots' centre and size are those of the box around them", () => {
  const stage = drawn(new Stage(description(), null), snapshot(0, 0));
  near(stage.center.y, 0.5);
  near(stage.center.z, 0.1);
  near(stage.radius, Math.hypot(0.2, 1.2, 0.2) / 2);
});

test("an obstacle is drawn at its pose, and the picture is of the robots", () => {
  const stage = new Stage(description(undefined, 1), null);
  const shown = snapshot(0, 0);
  shown.subjects[0].poses = new Float64Array([...shown.subjects[0].poses, 7, 8, 9, 1, 0, 0, 0]);
  drawn(stage, shown);
  assert.deepEqual([...stage.drawn[0].slice(14)], [7, 8, 9, 1, 0, 0, 0]);
  near(stage.radius, Math.hypot(0.2, 1.2, 0.2) / 2);
  near(stage.surround, 4 * stage.radius);
  near(stage.weight, 20);
  // From the robots' middle, (0, 0.5, 0.1), to the farthest corner of a cube 1 m above.
  shown.subjects[0].poses.set([0, 0.5, 1.1], 14);
  const near_by = drawn(new Stage(description(undefined, 1), null), shown);
  near(near_by.surround, Math.hypot(0.1, 0.1, 1.1));
});

test("a contact is drawn on its body, however much that is exaggerated", () => {
  const stage = new Stage(description(), null);
  stage.exaggeration = 1e5;
  drawn(stage, snapshot(0, 0));
  drawn(stage, snapshot(10, 1e-6));
  near(stage.drawn[0][0], 0.1);
  const point = stage.drawnPoint(0, 0, 0.1 + 1e-6, 0.1, 0, new Vector3());
  near(point.x, 0.2);
  near(point.z, 0);
  near(stage.realPoint(0, 0, new Vector3(0.1, 0.1, -0.1), new Vector3()).x, 0.1 + 1e-6, 1e-15);
});

test("displacements are measured from the description's start, where it has one, else from the first snapshot or step 0", () => {
  const told = new Stage(description([0, 0, 0.1, 1, 0, 0, 0]), null);
  told.exaggeration = 1000;
  near(drawn(told, snapshot(50, 1e-4)).drawn[0][0], 0.1);
  const seen = new Stage(description(), null);
  seen.exaggeration = 1000;
  near(drawn(seen, snapshot(50, 1e-4)).drawn[0][0], 1e-4);
  near(drawn(seen, snapshot(60, 2e-4)).drawn[0][0], 1e-4 + 0.1);
  near(drawn(seen, snapshot(0, 0)).drawn[0][0], 0);
  near(drawn(seen, snapshot(10, 1e-4)).drawn[0][0], 0.1);
});

test("only what slides leaves a trace, at the spacing asked for", () => {
  const stage = new Stage(description(), null);
  const places = new SlipPlaces();
  for (let step = 0; step < 100; ++step) places.take(drawn(stage, snapshot(step, 0.001 * step)), 0.0095);
  assert.equal(places.count, 0);
  for (let step = 100; step < 200; ++step) places.take(drawn(stage, snapshot(step, 0.001 * step, 1)), 0.0095);
  assert.equal(places.count, 10);
  near(places.place(0, new Vector3()).x, 0.2);
  near(places.place(9, new Vector3()).x, 0.29);
});

test("going back in time takes back what slid later", () => {
  const stage = new Stage(description(), null);
  const places = new SlipPlaces();
  for (let step = 0; step < 100; ++step) places.take(drawn(stage, snapshot(step, 0.01 * step, 1)), 0.001);
  assert.equal(places.count, 100);
  places.take(drawn(stage, snapshot(49, 0.49, 0)), 0.001);
  assert.equal(places.count, 50);
});

test("the oldest traces make way", () => {
  const stage = new Stage(description(), null);
  const places = new SlipPlaces();
  for (let step = 0; step < 10000; ++step) places.take(drawn(stage, snapshot(step, step, 1)), 0.5);
  assert.equal(places.count, 8192);
  near(places.place(8191, new Vector3()).x, 9999.1);
  near(places.place(0, new Vector3()).x, 9999.1 - 8191);
});

test("the camera reaches what creeps far away, and not what has no place", () => {
  const stage = new Stage(description([0, 0, 0.1, 1, 0, 0, 0]), null);
  stage.exaggeration = 1000;
  // The second robot stands a metre beside the place where it started.
  near(drawn(stage, snapshot(1, 0.02)).farthest, Math.hypot(20, 1000, 0.1), 1e-6);
  drawn(stage, snapshot(2, NaN));
  near(stage.farthest, 0);
});

// A person set another pose to start from: from there displacements count, whatever the description said.
test("a run that starts again from another pose is measured from there", () => {
  const stage = drawn(new Stage(description([0, 0, 0.1, 1, 0, 0, 0]), null), snapshot(0, 0));
  near(drawn(stage, snapshot(5, 0.5)).displacement(0, 0, new Vector3()).x, 0.5);
  near(drawn(stage, snapshot(0, 0.4)).displacement(0, 0, new Vector3()).x, 0);
  near(drawn(stage, snapshot(5, 0.5)).displacement(0, 0, new Vector3()).x, 0.1);
});
