// What bodies look like of which no shape says so: sticks from joint to joint and to the points that touch, a ball at the centre of
// mass, a plinth under a base that stands still. They are shapes like any other, so that they are picked, throw shadows and have ghosts.
import { Matrix4, Quaternion, Vector3 } from "three";
import type { Body, Shape } from "../protocol.ts";
import { inertiaBox } from "./inertia.ts";
import { placeMatrix } from "./robots.ts";
import { trianglesOf } from "./shapes.ts";

// Of the radius of a ball around the robot.
const stickRadius = 0.018;
const ballRadius = 0.05;
const footRadius = 0.03;
const plinthEdge = 0.12;
const shortest = 0.04; // of sticks that are drawn
const air = 0.06; // between a shape and a joint that it reaches
const mostFeet = 64;
const mostCorners = 12;
const densityOfPoints = 1000; // [kg/m^3], of a body that is a point with mass

/// The bodies, each with at least one shape where it has mass, children or points.
export function figured(bodies: Body[]): Body[] {
  if (bodies.some((body) => body.start === undefined)) return bodies;
  const children = bodies.map((_, k) => bodies.flatMap((body, child) => (body.parent === k ? [jointOf(bodies, child)] : [])));
  const sizes = new Map<number, number>();
  return bodies.map((body, k) => {
    if (body.robot < 0) return body;
    let size = sizes.get(body.robot);
    if (size === undefined) sizes.set(body.robot, (size = sizeOf(bodies, body.robot)));
    const own = figureOf(body, children[k], size);
    return own.length === 0 ? body : { ...body, shapes: [...body.shapes, ...own] };
  });
}

/// Where a body's joint is in the axes of the body that carries it.
function jointOf(bodies: Body[], child: number): Vector3 {
  const place = poseOf(bodies[bodies[child].parent]).invert();
  return new Vector3().setFromMatrixPosition(poseOf(bodies[child])).applyMatrix4(place);
}
function poseOf(body: Body): Matrix4 {
  return placeMatrix(new Matrix4(), Float64Array.from(body.start!), 0);
}

/// Half the diagonal of the box around a robot's joints, centres of mass, points and shapes at the start [m]; of one point, so that
/// its ball has its mass.
function sizeOf(bodies: Body[], robot: number): number {
  const [least, greatest, at] = [new Vector3(Infinity, Infinity, Infinity), new Vector3(-Infinity, -Infinity, -Infinity), new Vector3()];
  let mass = 0;
  for (const body of bodies) {
    if (body.robot !== robot) continue;
    mass += body.mass;
    const place = poseOf(body);
    const { positions } = trianglesOf(body.shapes);
    for (const each of [[0, 0, 0], body.center_of_mass, ...body.points, ...chunks(positions)]) {
      at.fromArray(each).applyMatrix4(place);
      least.min(at);
      greatest.max(at);
    }
  }
  const ofPoints = Math.cbrt((3 * mass) / (4 * Math.PI * densityOfPoints)) / ballRadius;
  return least.distanceTo(greatest) / 2 > 1e-6 * ofPoints ? least.distanceTo(greatest) / 2 : ofPoints;
}
function chunks(numbers: number[]): number[][] {
  return Array.from({ length: numbers.length / 3 }, (_, i) => numbers.slice(3 * i, 3 * i + 3));
}

function figureOf(body: Body, joints: Vector3[], size: number): Shape[] {
  const center = new Vector3(...body.center_of_mass);
  if (body.shapes.length > 0) {
    const own = body.parent >= 0 ? [new Vector3()] : [];
    return [...own, ...joints].flatMap((joint) => bridge(body, joint, size));
  }
  const shapes: Shape[] = [];
  const fixed = body.parent < 0 && body.mass === 0;
  const origin = new Vector3();
  if (fixed && size > 0) shapes.push({ kind: "box", dimensions: [plinthEdge * size, plinthEdge * size, plinthEdge * size], location: [0, 0, 0], orientation: [1, 0, 0, 0] });
  for (const joint of joints) shapes.push(...stick(origin, joint, size));
  const feet = body.points.slice(0, mostFeet).map((point) => new Vector3(...point));
  const hub = body.mass > 0 ? center : origin;
  const solid = joints.length === 0 && body.parent < 0 ? solidOf(feet, center) : null;
  if (solid !== null) return [solid];
  for (const foot of feet) shapes.push(...stick(hub, foot, size), ball(foot, footRadius * size));
  // A link hangs on its joint; a base has none, and its sticks to others begin at its origin.
  if (body.parent >= 0 || joints.length > 0) shapes.push(...stick(origin, hub, size));
  if (!(body.mass > 0)) return shapes;
  if (shapes.length > 0) shapes.push(ball(center, ballRadius * size));
  else shapes.push(lump(body, center, size));
  return shapes;
}

/// The solid whose corners a few points are, about the centre of mass: a cube told by its corners. Null where they are none.
function solidOf(corners: Vector3[], center: Vector3): Shape | null {
  if (corners.length < 4 || corners.length > mostCorners) return null;
  const size = Math.max(...corners.map((corner) => corner.distanceTo(center)));
  const faces = new Map<string, number[]>();
  for (let a = 0; a < corners.length; ++a)
    for (let b = 0; b < corners.length; ++b)
      for (let c = 0; c < corners.length; ++c) {
        if (a >= b || a >= c || b === c) continue;
        const normal = corners[b].clone().sub(corners[a]).cross(corners[c].clone().sub(corners[a]));
        if (normal.length() < 1e-9 * size * size) continue;
        normal.normalize();
        const heights = corners.map((corner) => corner.clone().sub(corners[a]).dot(normal));
        if (heights.some((height) => height > 1e-6 * size)) continue;
        if (center.clone().sub(corners[a]).dot(normal) > -0.1 * size) return null;
        const face = heights.flatMap((height, corner) => (height > -1e-6 * size ? [corner] : []));
        faces.set(face.join(" "), inOrder(face, corners, normal));
      }
  if (new Set([...faces.values()].flat()).size < corners.length) return null; // one is inside
  return { kind: "hull", vertices: corners.flatMap((corner) => corner.toArray()), faces: [...faces.values()], location: [0, 0, 0], orientation: [1, 0, 0, 0] };
}
/// Corners of a convex face, counter-clockwise about its normal.
function inOrder(face: number[], corners: Vector3[], normal: Vector3): number[] {
  const middle = new Vector3();
  for (const corner of face) middle.addScaledVector(corners[corner], 1 / face.length);
  const along = corners[face[0]].clone().sub(middle).normalize();
  const across = normal.clone().cross(along);
  const angle = (corner: number) => {
    const from = corners[corner].clone().sub(middle);
    return Math.atan2(from.dot(across), from.dot(along));
  };
  return [...face].sort((one, other) => angle(one) - angle(other));
}

/// Between what a shape of the body reaches and a joint that is beyond it.
function bridge(body: Body, joint: Vector3, size: number): Shape[] {
  const [least, greatest, at] = [new Vector3(Infinity, Infinity, Infinity), new Vector3(-Infinity, -Infinity, -Infinity), new Vector3()];
  const { positions } = trianglesOf(body.shapes);
  for (let k = 0; k < positions.length; k += 3) {
    least.min(at.fromArray(positions, k));
    greatest.max(at);
  }
  const near = joint.clone().clamp(least, greatest);
  return near.distanceTo(joint) <= air * size ? [] : stick(near.add(least.add(greatest).multiplyScalar(0.5)).multiplyScalar(0.5), joint, size);
}

function stick(from: Vector3, to: Vector3, size: number): Shape[] {
  const along = to.clone().sub(from);
  const length = along.length();
  if (!(length > shortest * size)) return [];
  const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), along.multiplyScalar(1 / length));
  return [{
    kind: "capsule", radius: stickRadius * size, length,
    location: from.clone().add(to).multiplyScalar(0.5).toArray(), orientation: [turn.w, turn.x, turn.y, turn.z],
  }];
}
function ball(at: Vector3, radius: number): Shape {
  return { kind: "sphere", radius, location: at.toArray(), orientation: [1, 0, 0, 0] };
}
/// A body by itself: the box of its inertia, whose turning is seen, or a ball of its mass.
function lump(body: Body, center: Vector3, size: number): Shape {
  const box = inertiaBox(body.mass, body.inertia);
  const longest = box === null ? 0 : Math.max(...box.edges.toArray());
  // Beside other bodies it is no larger than they are: a plane mechanism has inertia that only holds it upright.
  if (box !== null && longest > 2 * ballRadius * size && longest < 2 * size) {
    const { orientation: turn } = box;
    const thinnest = 0.05 * longest;
    const dimensions = box.edges.toArray().map((edge) => Math.max(edge, thinnest)) as [number, number, number];
    return { kind: "box", dimensions, location: center.toArray(), orientation: [turn.w, turn.x, turn.y, turn.z] };
  }
  return ball(center, ballRadius * size);
}
