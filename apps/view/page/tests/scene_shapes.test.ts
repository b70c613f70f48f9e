// Meshes against volumes and areas from the textbook, inertia boxes against boxes, the plane of a pull against one by hand.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Matrix4, Quaternion, Ray, Vector3 } from "three";
import type { Shape } from "../protocol.ts";
import { roundScale } from "../scene/contacts.ts";
import { inertiaBox, principalAxes } from "../scene/inertia.ts";
import { grouped, lengthText } from "../scene/overlay.ts";
import { Light } from "../scene/matte.ts";
import { onPlane } from "../scene/pull.ts";
import { type Triangles, trianglesOf } from "../scene/shapes.ts";
import { Ground } from "../scene/terrain.ts";

function near(actual: number, expected: number, tolerance = 1e-12): void {
  assert.ok(Math.abs(actual - expected) <= tolerance * Math.max(1, Math.abs(expected)), `${actual} is not ${expected}`);
}
const placed = { location: [0.3, -0.2, 0.1] as [number, number, number], orientation: [Math.cos(0.4), Math.sin(0.4), 0, 0] as [number, number, number, number] };

function corner(mesh: Triangles, index: number): Vector3 {
  return new Vector3().fromArray(mesh.positions, 3 * index);
}
/// By the divergence theorem: sixths of the triple products of all triangles; positive where they face outwards.
function volume(mesh: Triangles): number {
  let sum = 0;
  for (let k = 0; k < mesh.indices.length; k += 3) {
    const [a, b, c] = mesh.indices.slice(k, k + 3).map((each) => corner(mesh, each));
    sum += a.dot(b.cross(c)) / 6;
  }
  return sum;
}
function facesOutwards(mesh: Triangles): void {
  for (let k = 0; k < mesh.indices.length; k += 3) {
    const [i, j, l] = mesh.indices.slice(k, k + 3);
    const face = corner(mesh, j).sub(corner(mesh, i)).cross(corner(mesh, l).sub(corner(mesh, i)));
    for (const each of [i, j, l]) {
      const normal = new Vector3().fromArray(mesh.normals, 3 * each);
      near(normal.length(), 1);
      assert.ok(face.dot(normal) > 0, "a normal against its triangle");
    }
  }
}
// A polygon of 32 corners in place of the circle.
const polygon = (32 / (2 * Math.PI)) * Math.sin((2 * Math.PI) / 32);

test("a box", () => {
  const mesh = trianglesOf([{ ...placed, kind: "box", dimensions: [0.3, 0.2, 0.06] }]);
  near(volume(mesh), 0.3 * 0.2 * 0.06);
  facesOutwards(mesh);
  assert.equal(mesh.edges.length / 6, 12);
});

test("a cylinder is along z and centred", () => {
  const mesh = trianglesOf([{ kind: "cylinder", radius: 0.1, length: 0.4, location: [0, 0, 0], orientation: [1, 0, 0, 0] }]);
  near(volume(mesh), Math.PI * 0.01 * 0.4 * polygon);
  facesOutwards(mesh);
  const heights = mesh.positions.filter((_, k) => k % 3 === 2);
  near(Math.max(...heights), 0.2);
  near(Math.min(...heights), -0.2);
});

test("a legcone is a truncated cone along +x from its origin", () => {
  const cone: Shape = { kind: "legcone", length: 1, proximal_radius: 0.15, distal_radius: 0.1, location: [0, 0, 0], orientation: [1, 0, 0, 0] };
  const mesh = trianglesOf([cone]);
  near(volume(mesh), (Math.PI / 3) * (0.15 ** 2 + 0.15 * 0.1 + 0.1 ** 2) * polygon);
  facesOutwards(mesh);
  for (let k = 0; k < mesh.positions.length / 3; ++k) {
    const at = corner(mesh, k);
    const radius = Math.hypot(at.y, at.z);
    assert.ok(radius < 1e-12 || Math.abs(radius - (0.15 - 0.05 * at.x)) < 1e-12);
    const normal = new Vector3().fromArray(mesh.normals, 3 * k);
    // On an end, or across the line from rim to rim.
    const line = new Vector3(1, (-0.05 * at.y) / radius, (-0.05 * at.z) / radius);
    assert.ok(Math.abs(normal.x) === 1 || Math.abs(normal.dot(line)) < 1e-12);
  }
  near(volume(trianglesOf([{ ...cone, ...placed }])), volume(mesh));
});

test("a legcone that ends in a point, either way", () => {
  const cone = { kind: "legcone", length: 0.15, location: [0, 0, 0], orientation: [1, 0, 0, 0] } as const;
  for (const radii of [{ proximal_radius: 0.01, distal_radius: 0 }, { proximal_radius: 0, distal_radius: 0.01 }]) {
    const mesh = trianglesOf([{ ...cone, ...radii } as unknown as Shape]);
    near(volume(mesh), (Math.PI / 3) * 0.01 ** 2 * 0.15 * polygon);
    facesOutwards(mesh);
  }
});

test("a capsule is a cylinder between half balls, of which nothing lies inside", () => {
  const capsule: Shape = { kind: "capsule", radius: 0.1, length: 0.4, location: [0, 0, 0], orientation: [1, 0, 0, 0] };
  const mesh = trianglesOf([capsule]);
  facesOutwards(mesh);
  for (let k = 0; k < mesh.positions.length / 3; ++k) {
    const at = corner(mesh, k);
    assert.ok(Math.abs(at.z) > 0.2 - 1e-9);
    near(Math.hypot(at.x, at.y, Math.abs(at.z) - 0.2), 0.1);
  }
  const balls = volume(mesh) - Math.PI * 0.01 * 0.4 * polygon;
  assert.ok(Math.abs(balls / ((4 / 3) * Math.PI * 0.001) - 1) < 0.02);
});

// A disc has both of its faces, one over the other, and no face inside out.
test("a disc is as thin as can be drawn", () => {
  const mesh = trianglesOf([{ kind: "cylinder", radius: 0.1, length: 0, location: [0, 0, 0], orientation: [1, 0, 0, 0] }]);
  facesOutwards(mesh);
  for (let k = 0; k < mesh.positions.length / 3; ++k) near(Math.abs(corner(mesh, k).z), 0.001);
});

test("a hull has its faces, and each edge once", () => {
  const corner: Shape = {
    ...placed, kind: "hull", vertices: [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1],
    faces: [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
  };
  const mesh = trianglesOf([corner]);
  near(volume(mesh), 1 / 6);
  facesOutwards(mesh);
  assert.equal(mesh.edges.length, 6 * 6);
});

test("a sphere", () => {
  const mesh = trianglesOf([{ ...placed, kind: "sphere", radius: 0.1 }]);
  assert.ok(Math.abs(volume(mesh) / ((4 / 3) * Math.PI * 0.001) - 1) < 0.02);
  for (let k = 0; k < mesh.positions.length / 3; ++k) near(corner(mesh, k).distanceTo(new Vector3(...placed.location)), 0.1);
});

test("the inertia box of a box is the box", () => {
  const [a, b, c, m] = [0.3, 0.2, 0.06, 2];
  const moments = [(m * (b * b + c * c)) / 12, (m * (a * a + c * c)) / 12, (m * (a * a + b * b)) / 12];
  const box = inertiaBox(m, [moments[0], moments[1], moments[2], 0, 0, 0])!;
  near(box.edges.x, a);
  near(box.edges.y, b);
  near(box.edges.z, c);
});

test("the inertia box of a turned box is turned", () => {
  const [a, b, c, m] = [0.3, 0.2, 0.06, 2];
  const turn = new Matrix4().makeRotationFromQuaternion(new Quaternion(0.2, -0.5, 0.3, 0.7).normalize()).elements;
  const moments = [(m * (b * b + c * c)) / 12, (m * (a * a + c * c)) / 12, (m * (a * a + b * b)) / 12];
  // I = R diag(moments) R^T, elements of R in columns of four.
  const element = (i: number, j: number) => [0, 1, 2].reduce((sum, k) => sum + turn[4 * k + i] * moments[k] * turn[4 * k + j], 0);
  const inertia: [number, number, number, number, number, number] = [element(0, 0), element(1, 1), element(2, 2), element(0, 1), element(0, 2), element(1, 2)];
  const box = inertiaBox(m, inertia)!;
  const edges = box.edges.toArray().sort();
  [c, b, a].forEach((each, k) => near(edges[k], each, 1e-9));
  const rebuilt = principalAxes(inertia);
  for (const [i, j, expected] of [[0, 0, inertia[0]], [0, 1, inertia[3]], [1, 2, inertia[5]]])
    near([0, 1, 2].reduce((sum, k) => sum + rebuilt.axes[i][k] * rebuilt.moments[k] * rebuilt.axes[j][k], 0), expected);
});

test("a body without mass has no inertia box, a rod a thin one", () => {
  assert.equal(inertiaBox(0, [0, 0, 0, 0, 0, 0]), null);
  const rod = inertiaBox(1, [0, 1 / 12, 1 / 12, 0, 0, 0])!;
  near(rod.edges.x, 1);
  near(rod.edges.y, 0);
});

test("a pull stays in the plane through its point", () => {
  const out = new Vector3();
  // From (0, -3, 0) towards (1, 1, 0.5): the plane y = 1 is met at four times the direction.
  const ray = new Ray(new Vector3(0, -3, 0), new Vector3(0.25, 1, 0.125).normalize());
  assert.ok(onPlane(ray, new Vector3(5, 1, -7), new Vector3(0, -1, 0), out));
  near(out.x, 1);
  near(out.y, 1);
  near(out.z, 0.5);
  assert.ok(!onPlane(ray, new Vector3(0, -4, 0), new Vector3(0, -1, 0), out), "behind the camera");
  assert.ok(!onPlane(new Ray(new Vector3(), new Vector3(1, 0, 0)), new Vector3(0, 1, 0), new Vector3(0, 1, 0), out), "parallel");
});

test("the ground's normal under a point", () => {
  const ground = new Ground({ vertices: [0, 0, 0, 1, 0, -1, 1, 1, -1, 0, 1, 0], tiles: [[0, 0, 1, 2, 3]], body: -1, endless: null }, new Light());
  const normal = ground.normalAt(0.5, 0.2);
  near(normal.x, Math.SQRT1_2);
  near(normal.z, Math.SQRT1_2);
  near(ground.normalAt(5, 5).z, 1);
});

// A step of 1 m: the riser at x = 1 is over no point.
test("a riser is not what stands under a point", () => {
  const vertices = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, 1, 2, 0, 1, 2, 1, 1, 1, 1, 1];
  const ground = new Ground({ vertices, tiles: [[0, 2, 1, 4, 7], [0, 0, 1, 2, 3], [0, 4, 5, 6, 7]], body: -1, endless: null }, new Light());
  near(ground.normalAt(1, 0.5).z, 1);
});

// A quarter turn about x, one metre up: y points up and z to -y.
test("ground that moves is drawn at its pose", () => {
  const terrain = { vertices: [0, 0, 0, 1, 0, 0, 1, 1, 0], tiles: [[0, 0, 1, 2]], body: 1, endless: null };
  const ground = new Ground(terrain, new Light());
  ground.place(new Float64Array([9, 9, 9, 1, 0, 0, 0, 0, 0, 1, Math.SQRT1_2, Math.SQRT1_2, 0, 0]), new Vector3(), 1, 1);
  const corner = new Vector3(1, 1, 0).applyMatrix4(ground.group.matrix);
  near(corner.x, 1);
  near(corner.y, 0);
  near(corner.z, 2);
});

test("scales and units", () => {
  for (const [value, expected] of [[0.00031, 0.0005], [1, 1], [1.01, 2], [7, 10], [0.0002, 0.0002]]) near(roundScale(value), expected);
  assert.equal(grouped(1000000), "1\u202f000\u202f000");
  assert.equal(lengthText(0.0005), "500 \u00b5m");
  assert.equal(lengthText(0.0021), "2.1 mm");
  assert.equal(lengthText(2e-6), "2 \u00b5m");
});
