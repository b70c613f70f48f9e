// Triangles, edges and outlines of a body's shapes, in body axes: one mesh and one set of lines a body.
import { BufferAttribute, BufferGeometry, Quaternion, Vector3 } from "three";
import type { Shape } from "../protocol.ts";

const around = 32; // segments of a circle
const rings = 16; // of a sphere, pole to pole
const thinnest = 0.02; // of a disc's radius: a thinner one's far face would show through its near one

/// `outline` is where a corner goes when the shape swells; unlike `normals` it does not break at an edge.
export class Triangles {
  readonly positions: number[] = [];
  readonly normals: number[] = [];
  readonly outline: number[] = [];
  readonly indices: number[] = [];
  readonly edges: number[] = []; // x y z of both ends

  constructor(
    private location: Vector3 = new Vector3(),
    private orientation: Quaternion = new Quaternion(),
  ) {}
  place(shape: Shape): void {
    this.location = new Vector3(...shape.location);
    const [w, x, y, z] = shape.orientation;
    this.orientation = new Quaternion(x, y, z, w);
  }
  vertex(position: Vector3, normal: Vector3, outline: Vector3): number {
    this.positions.push(...position.clone().applyQuaternion(this.orientation).add(this.location));
    this.normals.push(...normal.clone().normalize().applyQuaternion(this.orientation));
    this.outline.push(...outline.clone().normalize().applyQuaternion(this.orientation));
    return this.positions.length / 3 - 1;
  }
  triangle(a: number, b: number, c: number): void {
    this.indices.push(a, b, c);
  }
  edge(a: Vector3, b: Vector3): void {
    for (const end of [a, b]) this.edges.push(...end.clone().applyQuaternion(this.orientation).add(this.location));
  }
  mesh(): BufferGeometry {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(this.positions), 3));
    geometry.setAttribute("normal", new BufferAttribute(new Float32Array(this.normals), 3));
    geometry.setAttribute("outline", new BufferAttribute(new Float32Array(this.outline), 3));
    geometry.setIndex(this.indices);
    return geometry;
  }
  lines(): BufferGeometry {
    return new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(this.edges), 3));
  }
}

function addBox(to: Triangles, dimensions: Vector3): void {
  const half = dimensions.clone().multiplyScalar(0.5);
  const axes = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];
  for (let axis = 0; axis < 3; ++axis) {
    for (const side of [-1, 1]) {
      const normal = axes[axis].clone().multiplyScalar(side);
      const u = axes[(axis + 1) % 3];
      const v = axes[(axis + 2) % 3].clone().multiplyScalar(side); // u x v is the normal
      const corner = (i: number, j: number) => {
        const sign = normal.clone().addScaledVector(u, i).addScaledVector(v, j);
        return to.vertex(sign.clone().multiply(half), normal, sign);
      };
      const [a, b, c, d] = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
      to.triangle(a, b, c);
      to.triangle(a, c, d);
    }
    for (const i of [-1, 1]) {
      for (const j of [-1, 1]) {
        const end = (k: number) =>
          axes[axis].clone().multiplyScalar(k).addScaledVector(axes[(axis + 1) % 3], i)
            .addScaledVector(axes[(axis + 2) % 3], j).multiply(half);
        to.edge(end(-1), end(1));
      }
    }
  }
}

/// A ball, or the part of it between two of its rings.
function addSphere(to: Triangles, radius: number, center = new Vector3(), [lowest, highest] = [0, rings]): void {
  const index = (ring: number, step: number) => first + (ring - lowest) * (around + 1) + step;
  const first = to.positions.length / 3;
  for (let ring = lowest; ring <= highest; ++ring) {
    const latitude = Math.PI * (ring / rings - 0.5);
    for (let step = 0; step <= around; ++step) {
      const longitude = (2 * Math.PI * step) / around;
      const direction = new Vector3(
        Math.cos(latitude) * Math.cos(longitude),
        Math.cos(latitude) * Math.sin(longitude),
        Math.sin(latitude),
      );
      to.vertex(direction.clone().multiplyScalar(radius).add(center), direction, direction);
    }
  }
  for (let ring = lowest; ring < highest; ++ring) {
    for (let step = 0; step < around; ++step) {
      const [a, b] = [index(ring, step), index(ring, step + 1)];
      const [c, d] = [index(ring + 1, step + 1), index(ring + 1, step)];
      if (ring > 0) to.triangle(a, b, c);
      if (ring < rings - 1) to.triangle(a, c, d);
    }
  }
}

/// A cylinder or truncated cone from p = `from` to p + length `axis`, with flat ends unless it is `open`.
function addCone(to: Triangles, axis: Vector3, from: Vector3, length: number, radii: [number, number], open = false): void {
  const u = new Vector3(axis.y, axis.z, axis.x);
  const v = new Vector3().crossVectors(axis, u);
  const radial = (step: number) => {
    const angle = (2 * Math.PI * step) / around;
    return u.clone().multiplyScalar(Math.cos(angle)).addScaledVector(v, Math.sin(angle));
  };
  const centers = [from, from.clone().addScaledVector(axis, length)];
  const side: number[][] = [[], []];
  for (let step = 0; step <= around; ++step) {
    const normal = radial(step).multiplyScalar(length).addScaledVector(axis, radii[0] - radii[1]).normalize();
    for (const end of [0, 1]) {
      const outline = normal.clone().addScaledVector(axis, end === 0 ? -1 : 1);
      const at = centers[end].clone().addScaledVector(radial(step), radii[end]);
      side[end].push(to.vertex(at, normal, outline));
    }
  }
  for (let step = 0; step < around; ++step) {
    if (radii[0] > 0) to.triangle(side[0][step], side[0][step + 1], side[1][step + 1]);
    if (radii[1] > 0) to.triangle(side[0][step], side[1][step + 1], side[1][step]);
  }
  for (const end of [0, 1]) {
    if (radii[end] === 0 || open) continue;
    const outwards = axis.clone().multiplyScalar(end === 0 ? -1 : 1);
    const center = to.vertex(centers[end], outwards, outwards);
    const rim: number[] = [];
    for (let step = 0; step <= around; ++step) {
      const at = centers[end].clone().addScaledVector(radial(step), radii[end]);
      rim.push(to.vertex(at, outwards, radial(step).add(outwards)));
    }
    for (let step = 0; step < around; ++step) {
      const [a, b] = end === 0 ? [rim[step + 1], rim[step]] : [rim[step], rim[step + 1]];
      to.triangle(center, a, b);
      const ends = [radial(step), radial(step + 1)].map((each) => each.multiplyScalar(radii[end]).add(centers[end]));
      to.edge(ends[0], ends[1]);
    }
  }
}

/// A capsule: a cylinder with half a ball at each end.
function addCapsule(to: Triangles, radius: number, length: number): void {
  const z = new Vector3(0, 0, 1);
  addCone(to, z, new Vector3(0, 0, -length / 2), length, [radius, radius], true);
  addSphere(to, radius, new Vector3(0, 0, -length / 2), [0, rings / 2]);
  addSphere(to, radius, new Vector3(0, 0, length / 2), [rings / 2, rings]);
}

/// A convex solid; an edge is drawn once.
function addHull(to: Triangles, vertices: number[], faces: number[][]): void {
  const at = (i: number) => new Vector3(...vertices.slice(3 * i, 3 * i + 3));
  const middle = new Vector3();
  for (let i = 0; 3 * i < vertices.length; ++i) middle.addScaledVector(at(i), 3 / vertices.length);
  for (const face of faces) {
    const normal = new Vector3();
    for (let i = 2; i < face.length; ++i) {
      const [a, b] = [at(face[i - 1]).sub(at(face[0])), at(face[i]).sub(at(face[0]))];
      normal.add(a.cross(b));
    }
    normal.normalize();
    const corners = face.map((i) => to.vertex(at(i), normal, at(i).sub(middle).normalize()));
    for (let i = 2; i < face.length; ++i) to.triangle(corners[0], corners[i - 1], corners[i]);
    for (let i = 0; i < face.length; ++i) {
      const [from, end] = [face[i], face[(i + 1) % face.length]];
      if (from < end) to.edge(at(from), at(end));
    }
  }
}

export function addShape(to: Triangles, shape: Shape): void {
  to.place(shape);
  switch (shape.kind) {
    case "box":
      addBox(to, new Vector3(...shape.dimensions));
      break;
    case "sphere":
      addSphere(to, shape.radius);
      break;
    case "cylinder": {
      const length = Math.max(shape.length, thinnest * shape.radius);
      addCone(to, new Vector3(0, 0, 1), new Vector3(0, 0, -length / 2), length, [shape.radius, shape.radius]);
      break;
    }
    case "legcone":
      addCone(to, new Vector3(1, 0, 0), new Vector3(), shape.length, [shape.proximal_radius, shape.distal_radius]);
      break;
    case "capsule":
      addCapsule(to, shape.radius, shape.length);
      break;
    case "hull":
      addHull(to, shape.vertices, shape.faces);
      break;
  }
}

export function trianglesOf(shapes: Shape[]): Triangles {
  const triangles = new Triangles();
  for (const shape of shapes) addShape(triangles, shape);
  return triangles;
}
