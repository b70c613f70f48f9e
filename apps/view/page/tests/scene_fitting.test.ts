import assert from "node:assert/strict";
import { test } from "node:test";
import { Vector3 } from "three";
import { fieldOfView } from "../scene/camera.ts";
import { edgePlace, largestExaggeration, sidesOf } from "../scene/fitting.ts";

// At euler1 = euler2 = 0 a camera looks along +y, x to the right and z up.
const ahead = { zoom: 1, distance: 2, euler1: 0, euler2: 0 };
const half = 2 * Math.tan(fieldOfView / 2); // of the picture's height at the point looked at
const mover = (moved: [number, number, number], start: [number, number, number] = [0, 0, 0], radius = 0) => ({ moved: new Vector3(...moved), start: new Vector3(...start), radius });

test("the largest factor brings a body to the edge of the picture", () => {
  const square = sidesOf(ahead, 1);
  const to = (...movers: ReturnType<typeof mover>[]) => largestExaggeration(square, movers, 1e6);
  assert.ok(Math.abs(to(mover([1e-4, 0, 0])) - Math.floor(half / 1e-4 / 100) * 100) < 1e-6, `${to(mover([1e-4, 0, 0]))}`);
  assert.equal(to(mover([0, 0, -1e-4])), to(mover([1e-4, 0, 0])));
  assert.ok(to(mover([1e-4, 0, 0], [half / 2, 0, 0])) < 0.51 * to(mover([1e-4, 0, 0])));
  assert.ok(to(mover([1e-4, 0, 0], [0, 0, 0], 0.2)) < to(mover([1e-4, 0, 0])));
  assert.equal(to(mover([1e-4, 0, 0]), mover([1e-3, 0, 0])), to(mover([1e-3, 0, 0])));
  // Away from the camera it stays in the picture for ever.
  assert.equal(to(mover([0, 1e-3, 0])), 1e6);
  assert.equal(to(mover([0, 0, 0])), 1e6);
});

test("a wide picture has room to the sides, and what has left at once does not count", () => {
  const wide = sidesOf(ahead, 2);
  const factor = largestExaggeration(wide, [mover([1e-4, 0, 0])], 1e6);
  assert.ok(Math.abs(factor / (2 * half / 1e-4) - 1) < 0.05, `${factor}`);
  assert.equal(largestExaggeration(wide, [mover([5, 0, 0]), mover([1e-4, 0, 0])], 1e6), factor);
  assert.equal(largestExaggeration(wide, [mover([half, 0, 0])], 1e6), 2);
});

test("an arrow stands at the edge in the direction of what has left", () => {
  assert.equal(edgePlace(0.9, -0.9, false, 200, 100, 10), null);
  assert.deepEqual(edgePlace(2, 0, false, 200, 100, 10), { x: 190, y: 50, angle: Math.atan2(-0, 200) });
  const above = edgePlace(0, 3, false, 200, 100, 10)!;
  assert.ok(above.x === 100 && above.y === 10 && Math.abs(above.angle + Math.PI / 2) < 1e-12);
  const corner = edgePlace(-4, -2, false, 200, 100, 10)!;
  assert.ok(corner.x >= 10 && corner.y <= 90 && corner.angle > Math.PI / 2);
  assert.ok(edgePlace(0.5, 0, true, 200, 100, 10)!.x === 10, "behind the camera right is left");
});
