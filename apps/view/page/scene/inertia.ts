// The box that has a body's mass and principal moments of inertia.
import { Matrix4, Quaternion, Vector3 } from "three";
import type { Body } from "../protocol.ts";

export interface InertiaBox {
  edges: Vector3;
  orientation: Quaternion; // of the principal axes in the body
}

/// Principal moments and axes (columns) of a symmetric 3x3 matrix by Jacobi's rotations.
export function principalAxes(inertia: Body["inertia"]): { moments: number[]; axes: number[][] } {
  const [xx, yy, zz, xy, xz, yz] = inertia;
  const a = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
  const v = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  const scale = Math.abs(xx) + Math.abs(yy) + Math.abs(zz);
  for (let sweep = 0; sweep < 30; ++sweep) {
    if (Math.abs(a[0][1]) + Math.abs(a[0][2]) + Math.abs(a[1][2]) <= 1e-15 * scale) break;
    for (const [p, q] of [[0, 1], [0, 2], [1, 2]]) {
      if (a[p][q] === 0) continue;
      const theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const t = (theta < 0 ? -1 : 1) / (Math.abs(theta) + Math.hypot(theta, 1));
      const c = 1 / Math.hypot(t, 1);
      const s = t * c;
      for (let k = 0; k < 3; ++k) [a[k][p], a[k][q]] = [c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]];
      for (let k = 0; k < 3; ++k) [a[p][k], a[q][k]] = [c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]];
      for (let k = 0; k < 3; ++k) [v[k][p], v[k][q]] = [c * v[k][p] - s * v[k][q], s * v[k][p] + c * v[k][q]];
    }
  }
  return { moments: [a[0][0], a[1][1], a[2][2]], axes: v };
}

/// A box with edges a, b, c has I1 = m (b^2 + c^2) / 12 and so on, hence a^2 = 6 (I2 + I3 - I1) / m. Null for a body without mass.
export function inertiaBox(mass: number, inertia: Body["inertia"]): InertiaBox | null {
  if (!(mass > 0)) return null;
  const { moments, axes } = principalAxes(inertia);
  const sum = moments[0] + moments[1] + moments[2];
  // Rounding can leave a thin rod's edge as the root of a small negative number.
  const edge = (moment: number) => Math.sqrt(Math.max(0, (6 * (sum - 2 * moment)) / mass));
  const column = (k: number) => new Vector3(axes[0][k], axes[1][k], axes[2][k]);
  // Jacobi's rotations have determinant 1: the axes are right-handed.
  const turn = new Matrix4().makeBasis(column(0), column(1), column(2));
  return {
    edges: new Vector3(edge(moments[0]), edge(moments[1]), edge(moments[2])),
    orientation: new Quaternion().setFromRotationMatrix(turn),
  };
}
