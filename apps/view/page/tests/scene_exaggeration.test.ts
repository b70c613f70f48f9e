// Exaggerated poses against p0 + e (p - p0) and rotations worked out by hand.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Quaternion, Vector3 } from "three";
import { exaggeratePose, largestAngle, rotationVector } from "../scene/exaggeration.ts";

function near(actual: number, expected: number, tolerance = 1e-12): void {
  assert.ok(Math.abs(actual - expected) <= tolerance, `${actual} is not ${expected}`);
}
function about(axis: Vector3, angle: number): number[] {
  const turn = new Quaternion().setFromAxisAngle(axis, angle);
  return [turn.w, turn.x, turn.y, turn.z];
}
function drawn(pose: number[], start: number[], factor: number, normal: Vector3 | null = null): Float64Array {
  const out = new Float64Array(7);
  exaggeratePose(out, new Float64Array(pose), new Float64Array(start), 0, factor, normal);
  return out;
}
const z = new Vector3(0, 0, 1);
const x = new Vector3(1, 0, 0);
const start = [1, 2, 3, ...about(x, 0.7)];

test("a factor of 1 leaves every bit of a pose", () => {
  const pose = [1.1, 2.2, 3.3, ...about(z, 2.9)];
  assert.deepEqual([...drawn(pose, start, 1)], pose);
});

test("a body that did not move is drawn where it is", () => {
  const out = drawn(start, start, 1e6);
  start.forEach((each, k) => near(out[k], each));
});

test("positions go to p0 + e (p - p0)", () => {
  const out = drawn([1 + 2e-6, 2 - 1e-6, 3, ...about(x, 0.7)], start, 1e5);
  near(out[0], 1.2, 1e-9);
  near(out[1], 1.9, 1e-9);
  near(out[2], 3, 1e-9);
});

test("a small rotation is drawn e times, before the start's orientation", () => {
  const first = new Quaternion().setFromAxisAngle(x, 0.7);
  const small = new Quaternion().setFromAxisAngle(z, 1e-6).multiply(first);
  const out = drawn([1, 2, 3, small.w, small.x, small.y, small.z], start, 1e5);
  const expected = new Quaternion().setFromAxisAngle(z, 0.1).multiply(first);
  near(out[3], expected.w, 1e-9);
  near(out[4], expected.x, 1e-9);
  near(out[5], expected.y, 1e-9);
  near(out[6], expected.z, 1e-9);
});

test("a rotation is drawn up to a radian, unless it is larger itself", () => {
  near(rotationVector(quaternion(drawn([0, 0, 0, ...about(z, 0.01)], [0, 0, 0, 1, 0, 0, 0], 1e4)), new Vector3()).z, largestAngle);
  near(rotationVector(quaternion(drawn([0, 0, 0, ...about(z, 2)], [0, 0, 0, 1, 0, 0, 0], 10)), new Vector3()).z, 2);
});
function quaternion(pose: Float64Array): Quaternion {
  return new Quaternion(pose[4], pose[5], pose[6], pose[3]);
}

test("along the ground only: sinking and tilting stay as they are", () => {
  const normal = new Vector3(Math.sin(0.3), 0, Math.cos(0.3));
  const along = new Vector3(Math.cos(0.3), 0, -Math.sin(0.3));
  const moved = along.clone().multiplyScalar(1e-6).addScaledVector(normal, -1e-4);
  const out = drawn([moved.x, moved.y, moved.z, ...about(new Vector3(0, 1, 0), 1e-5)], [0, 0, 0, 1, 0, 0, 0], 1e5, normal);
  const shown = new Vector3(out[0], out[1], out[2]);
  near(shown.dot(along), 0.1, 1e-9);
  near(shown.dot(normal), -1e-4, 1e-9);
  near(rotationVector(quaternion(out), new Vector3()).y, 1e-5, 1e-12);
});

test("the links of a body that turned a little stay joined", () => {
  // A rod from the origin, turned by 1e-7 rad about z, and a second body that hangs on its end at (1, 0, 0).
  const rod = drawn([0, 0, 0, ...about(z, 1e-7)], [0, 0, 0, 1, 0, 0, 0], 1e5);
  const end = x.clone().applyQuaternion(quaternion(rod));
  const second = drawn([Math.cos(1e-7), Math.sin(1e-7), 0, 1, 0, 0, 0], [1, 0, 0, 1, 0, 0, 0], 1e5);
  near(end.y, second[1], 1e-6);
  near(end.x, second[0], 1e-4);
});

test("both signs of a quaternion are the same rotation", () => {
  const turn = new Quaternion(0, 0, -Math.sin(0.1), -Math.cos(0.1));
  near(rotationVector(turn, new Vector3()).z, 0.2);
});
