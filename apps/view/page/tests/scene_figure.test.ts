// Bodies of which no shape says what they look like, and the camera that goes with them; lengths worked out by hand.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Vector3 } from "three";
import type { Body, Vector3 as Numbers } from "../protocol.ts";
import { Companion, firstMobileBase } from "../scene/companion.ts";
import { figured } from "../scene/figure.ts";
import { trianglesOf } from "../scene/shapes.ts";

function body(parent: number, mass: number, start: Numbers, center: Numbers = [0, 0, 0], points: Numbers[] = []): Body {
  return {
    trail: "world.robot.body", robot: 0, parent, mass, center_of_mass: center, inertia: [1e-9, 1e-9, 1e-9, 0, 0, 0], joint: parent < 0 ? null : "revolute",
    material: null, shapes: [], points, start: [...start, 1, 0, 0, 0],
  };
}
/// Least and greatest coordinates of what is drawn of a body, in its own axes.
function extent(of: Body): [Vector3, Vector3] {
  const [least, greatest] = [new Vector3(Infinity, Infinity, Infinity), new Vector3(-Infinity, -Infinity, -Infinity)];
  const { positions } = trianglesOf(of.shapes);
  for (let at = 0; at < positions.length; at += 3) {
    least.min(new Vector3().fromArray(positions, at));
    greatest.max(new Vector3().fromArray(positions, at));
  }
  return [least, greatest];
}

test("a rod reaches from its joint to its mass, and on to the joint that it carries", () => {
  const [base, rod, tip] = figured([body(-1, 0, [0, 0, 2]), body(0, 1, [0, 0, 2], [1, 0, 0]), body(1, 1, [0, 0, 1], [0, 0, 0])]);
  assert.equal(base.shapes.length, 1);
  const [least, greatest] = extent(rod);
  assert.ok(greatest.x > 1 && greatest.x < 1.1, `${greatest.x}`);
  assert.ok(least.z < -1 && least.z > -1.1, `${least.z}`);
  assert.equal(tip.shapes.length, 1);
});

test("a table stands on its legs", () => {
  const feet: Numbers[] = [[0.4, 0.3, -0.5], [0.4, -0.3, -0.5], [-0.4, 0.3, -0.5], [-0.4, -0.3, -0.5]];
  const [table] = figured([body(-1, 10, [0, 0, 0.5], [0, 0, 0], feet)]);
  const [least, greatest] = extent(table);
  assert.ok(least.z < -0.5 && least.z > -0.53 && greatest.z < 0.05);
});

test("corners about the centre of mass are those of a solid", () => {
  const corners = [-1, 1].flatMap((x) => [-1, 1].flatMap((y) => [-1, 1].map((z): Numbers => [x, y, z])));
  const [cube] = figured([body(-1, 1, [0, 0, 1], [0, 0, 0.1], corners)]);
  assert.equal(cube.shapes.length, 1);
  const [shape] = cube.shapes;
  assert.ok(shape.kind === "hull");
  assert.deepEqual(shape.faces.map((face) => face.length), [4, 4, 4, 4, 4, 4]);
  // Enclosed volume, by the divergence theorem: outward faces of a cube with edge 2.
  const { positions, indices } = trianglesOf(cube.shapes);
  let volume = 0;
  for (let at = 0; at < indices.length; at += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => new Vector3().fromArray(positions, 3 * indices[at + k]));
    volume += a.dot(b.cross(c)) / 6;
  }
  assert.ok(Math.abs(volume - 8) < 1e-9, `${volume}`);
});

// 4/3 pi r^3 of water.
test("a point with mass is a ball of it", () => {
  const [ball] = figured([body(-1, 1, [0, 0, 0])]);
  const [, greatest] = extent(ball);
  assert.ok(Math.abs(greatest.z - Math.cbrt(3 / (4 * Math.PI * 1000))) < 1e-9);
});

test("what has shapes keeps them, and a stick leads to what they do not reach", () => {
  const foot = { kind: "sphere", radius: 0.05, location: [0, 0, -1], orientation: [1, 0, 0, 0] } as const;
  const box = { kind: "box", dimensions: [1, 1, 1], location: [0, 0, 0], orientation: [1, 0, 0, 0] } as const;
  const bodies = [{ ...body(-1, 1, [0, 0, 2]), shapes: [box] }, { ...body(0, 1, [0.5, 0, 2]), shapes: [foot] }] as unknown as Body[];
  const [base, leg] = figured(bodies);
  assert.deepEqual(base.shapes, [box]);
  assert.equal(leg.shapes.length, 2);
  assert.ok(extent(leg)[1].z >= 0);
});

test("the camera goes with the first base that moves", () => {
  const obstacle = { ...body(-1, 5, [0, 0, 0]), robot: -1 };
  assert.equal(firstMobileBase([obstacle, body(-1, 0, [0, 0, 0]), body(1, 1, [0, 0, 0]), body(-1, 2, [0, 0, 0])]), 3);
  assert.equal(firstMobileBase([body(-1, 0, [0, 0, 0])]), -1);
});

// A first-order lag behind a ramp comes to v T, T = 0.3 s.
test("it lags behind steady motion by its time constant, and never by more than a part of its picture", () => {
  const companion = new Companion();
  for (let step = 0; step <= 3000; ++step) companion.follow(0.001 * step, new Vector3(0.001 * step, 0, 0), 10);
  assert.ok(Math.abs(companion.displacement.x - (3 - 0.3)) < 1e-3, `${companion.displacement.x}`);
  companion.follow(3.001, new Vector3(100, 0, 0), 1);
  assert.ok(Math.abs(companion.displacement.x - 99.7) < 1e-9, `${companion.displacement.x}`);
  companion.follow(3.002, new Vector3(NaN, 0, 0), 1);
  assert.ok(Number.isFinite(companion.displacement.x));
  companion.follow(1, new Vector3(1, 0, 0), 1);
  assert.equal(companion.displacement.x, 1);
});
