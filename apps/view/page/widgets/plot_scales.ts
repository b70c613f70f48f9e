// What plots need besides uPlot: ranges that follow the data, numbers on axes, and lines that may
// run back and forth.
import uPlot from "uplot";
import { engineering } from "../numbers.ts";
import type { Range } from "../protocol.ts";

/// Of the values of columns, where given only of times from `begin` to `end`; NaN are passed over.
export function rangeOf(columns: ArrayLike<number>[], times?: ArrayLike<number>, begin = -Infinity, end = Infinity): Range {
  let least = Infinity, greatest = -Infinity;
  for (const column of columns)
    for (let i = 0; i < column.length; ++i) {
      if (times !== undefined && (times[i] < begin || times[i] > end)) continue;
      if (column[i] < least) least = column[i];
      if (column[i] > greatest) greatest = column[i];
    }
  return least <= greatest ? [least, greatest] : [0, 1];
}

/// A little air around; around a single value as much as it takes to see that it does not move.
export function padded([least, greatest]: Range): Range {
  const size = Math.max(Math.abs(least), Math.abs(greatest));
  const span = greatest - least > 1e-12 * size ? greatest - least : size > 0 ? 0.2 * size : 2;
  const middle = (least + greatest) / 2;
  return [middle - 0.54 * span, middle + 0.54 * span];
}

/// The same where values are drawn by decades above `even` and below its negative, and evenly between.
export function paddedByDecades([least, greatest]: Range, even: number): Range {
  const place = (value: number) => Math.asinh(value / even);
  const [begin, end] = [place(Math.min(least, 0)), place(Math.max(greatest, 0))];
  const air = 0.06 * Math.max(end - begin, 1);
  return [even * Math.sinh(begin - air), even * Math.sinh(end + air)];
}

/// 0, and the powers of ten above `even`, of both signs: at most about eight.
export function decadesWithin(least: number, greatest: number, even: number): number[] {
  const first = Math.round(Math.log10(even)) + 1;
  const last = Math.floor(Math.log10(Math.max(-least, greatest, even)) + 1e-9);
  const every = Math.max(1, Math.ceil((last - first + 1) / 4));
  const ticks = [0];
  for (let power = last; power >= first; power -= every) ticks.push(10 ** power, -(10 ** power));
  return ticks.filter((tick) => tick >= least && tick <= greatest).sort((a, b) => a - b);
}

/// A power of ten in its unit, with a prefix where it is small.
export function decadeName(tick: number, inUnit: string): string {
  if (tick === 0) return "0";
  const { factor, unit } = engineering(Math.abs(tick), inUnit);
  const power = Math.round(Math.log10(Math.abs(tick / factor)));
  const size = power < -3 || power > 4 ? `1e${power}` : String(10 ** power);
  return `${((tick < 0 ? "-" : "") + size).replaceAll("-", "\u2212")} ${unit}`.trimEnd();
}

/// The line of a phase plot: uPlot's own lines take it that x only rises.
export const phasePath: uPlot.Series.PathBuilder = (plot, seriesIndex) => {
  const stroke = new Path2D();
  uPlot.orient(plot, seriesIndex, (_series, dataX, dataY, scaleX, scaleY, valToPosX, valToPosY, left, top, width, height) => {
    let gap = true;
    for (let i = 0; i < dataX.length; ++i) {
      const x = dataX[i], y = dataY[i];
      if (x === null || y === null || x === undefined || y === undefined || Number.isNaN(x) || Number.isNaN(y)) {
        gap = true;
        continue;
      }
      const atX = valToPosX(x, scaleX, width, left), atY = valToPosY(y, scaleY, height, top);
      if (gap) stroke.moveTo(atX, atY);
      else stroke.lineTo(atX, atY);
      gap = false;
    }
    return null;
  });
  const clip = new Path2D();
  clip.rect(plot.bbox.left, plot.bbox.top, plot.bbox.width, plot.bbox.height);
  return { stroke, fill: null, clip, band: null, flags: 0 };
};
