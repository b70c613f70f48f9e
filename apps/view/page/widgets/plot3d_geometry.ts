// How a plot in three dimensions comes onto a plane: the box of its ranges, seen without perspective
// so that lengths along an axis stay comparable.
import type { Range } from "../protocol.ts";

export type Point3 = [number, number, number];
export interface View {
  turn: number; // about z [rad]
  lift: number; // of the eye above the floor [rad]
}

/// Where a point is on the plane [pixels], and how far from the eye.
export function project(view: View, ranges: [Range, Range, Range], point: Point3, width: number, height: number): { x: number; y: number; depth: number } {
  const [x, y, z] = point.map((value, axis) => (value - ranges[axis][0]) / (ranges[axis][1] - ranges[axis][0]) - 0.5);
  const [c, s] = [Math.cos(view.turn), Math.sin(view.turn)];
  const across = c * x - s * y, away = s * x + c * y;
  const scale = Math.min(width - 110, (height - 70) * 1.15) / 1.5;
  return {
    x: width / 2 + 10 + scale * across,
    y: height / 2 - scale * (Math.cos(view.lift) * 0.8 * z + Math.sin(view.lift) * away),
    depth: Math.cos(view.lift) * away - Math.sin(view.lift) * z,
  };
}

/// About five round numbers within a range.
export function niceTicks([least, greatest]: Range): number[] {
  const rough = (greatest - least) / 5;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((each) => each >= rough) ?? 10 * power;
  const ticks: number[] = [];
  for (let i = Math.ceil(least / step - 1e-9); i * step <= greatest + 1e-9 * step; ++i) ticks.push(i * step + 0); // + 0: no minus zero
  return ticks;
}

const cells = 24;

/// The surface over scattered samples: the means of the cells of a grid, joined where all four corners are known.
export function surfaceOf(xs: ArrayLike<number>, ys: ArrayLike<number>, zs: ArrayLike<number>, rangeX: Range, rangeY: Range): Point3[][] {
  const sums = Array.from({ length: cells * cells }, () => ({ count: 0, x: 0, y: 0, z: 0 }));
  const cellOf = (value: number, [least, greatest]: Range) => Math.min(cells - 1, Math.max(0, Math.floor((cells * (value - least)) / (greatest - least))));
  for (let i = 0; i < xs.length; ++i) {
    if (Number.isNaN(xs[i] + ys[i] + zs[i])) continue;
    const sum = sums[cellOf(xs[i], rangeX) * cells + cellOf(ys[i], rangeY)];
    ++sum.count;
    sum.x += xs[i];
    sum.y += ys[i];
    sum.z += zs[i];
  }
  const mean = (i: number, j: number): Point3 | null => {
    const sum = sums[i * cells + j];
    return sum.count === 0 ? null : [sum.x / sum.count, sum.y / sum.count, sum.z / sum.count];
  };
  const tiles: Point3[][] = [];
  for (let i = 0; i + 1 < cells; ++i)
    for (let j = 0; j + 1 < cells; ++j) {
      const corners = [mean(i, j), mean(i + 1, j), mean(i + 1, j + 1), mean(i, j + 1)];
      if (corners.every((corner) => corner !== null)) tiles.push(corners as Point3[]);
    }
  return tiles;
}
