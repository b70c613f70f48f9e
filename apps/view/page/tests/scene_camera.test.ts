// The camera's pose against values worked out by hand.
import assert from "node:assert/strict";
import { test } from "node:test";
import { PerspectiveCamera, Vector3 } from "three";
import { type CameraValues, fittingDistance, moved, orbited, pixelsPerMetre, placeCamera, zoomed } from "../scene/camera.ts";

function near(actual: number, expected: number, tolerance = 1e-12): void {
  assert.ok(Math.abs(actual - expected) <= tolerance, `${actual} is not ${expected}`);
}
function nearVector(actual: Vector3, expected: [number, number, number], tolerance = 1e-12): void {
  expected.forEach((each, k) => near(actual.getComponent(k), each, tolerance));
}
function placed(values: CameraValues, target = new Vector3(), aspect = 4 / 3): PerspectiveCamera {
  const camera = new PerspectiveCamera();
  placeCamera(camera, values, target, aspect, 10);
  return camera;
}
const values = { zoom: 1, distance: 3, euler1: 0, euler2: 0 };

test("at both angles 0 it looks along +y with x to the right", () => {
  const camera = placed(values, new Vector3(1, 2, 3));
  nearVector(camera.position, [1, -1, 3]);
  nearVector(camera.getWorldDirection(new Vector3()), [0, 1, 0]);
  nearVector(new Vector3(1, 0, 0).applyQuaternion(camera.quaternion), [1, 0, 0]);
  nearVector(new Vector3(0, 1, 0).applyQuaternion(camera.quaternion), [0, 0, 1]);
});

test("euler1 of a quarter turn carries it from -y to +x", () => {
  const camera = placed({ ...values, euler1: Math.PI / 2 });
  nearVector(camera.position, [3, 0, 0]);
  nearVector(camera.getWorldDirection(new Vector3()), [-1, 0, 0]);
});

test("euler2 lifts it, up to straight above, where x is still to the right", () => {
  nearVector(placed({ ...values, euler2: Math.PI / 6 }).position, [0, -3 * Math.cos(Math.PI / 6), 1.5]);
  const above = placed({ ...values, euler2: Math.PI / 2 });
  nearVector(above.position, [0, 0, 3]);
  nearVector(new Vector3(1, 0, 0).applyQuaternion(above.quaternion), [1, 0, 0]);
  nearVector(new Vector3(0, 1, 0).applyQuaternion(above.quaternion), [0, 1, 0]);
});

test("the defaults of the file", () => {
  const camera = placed({ zoom: 1, distance: 3, euler1: 0.6, euler2: 0.4 });
  // 3 cos 0.4 sin 0.6, -3 cos 0.4 cos 0.6, 3 sin 0.4
  nearVector(camera.position, [1.5602105, -2.2805533, 1.168255], 1e-6);
});

test("zoom magnifies what is seen at the point looked at", () => {
  const point = new Vector3(0.1, 0, 0.05);
  const one = point.clone().project(placed(values));
  const four = point.clone().project(placed({ ...values, zoom: 4 }));
  near(four.x / one.x, 4);
  near(four.y / one.y, 4);
  // 40 degrees of the height at zoom 1: the half height at 3 m is 3 tan 20 degrees.
  near(one.y, 0.05 / (3 * 0.36397023426620234));
});

test("a picture that is taller than wide spans 40 degrees of its width", () => {
  const camera = placed(values, new Vector3(), 0.5);
  near(new Vector3(3 * 0.36397023426620234, 0, 0).project(camera).x, 1);
  near(pixelsPerMetre(values, 200, 400), 100 / (3 * 0.36397023426620234), 1e-9);
});

test("a ball seen from the fitting distance touches the picture's edge", () => {
  // The tangent from distance d to a ball of radius r makes asin(r / d) with the axis.
  near(Math.asin(0.5 / fittingDistance(0.5, 1)), (20 * Math.PI) / 180);
});

test("orbit stops at the zenith, distance and zoom stay positive", () => {
  assert.equal(orbited(values, 0.1, 5).euler2, Math.PI / 2);
  near(orbited(values, 0.1, 0).euler1, 0.1);
  assert.ok(moved(values, 0).distance > 0);
  assert.ok(zoomed(values, 0).zoom > 0);
});
