// The largest exaggeration at which all bodies are in the picture. A body is drawn at start + e moved, so that each side of the
// picture bounds e once, in closed form.
import { Vector3 } from "three";
import { type CameraValues, cameraAxes, halfHeight } from "./camera.ts";

export interface Mover {
  start: Vector3; // from the point looked at [m]
  moved: Vector3; // what is exaggerated [m]
  radius: number; // of a ball around it that is to be seen [m]
}

/// A side of the picture: inside, normal . p + offset is at least 0.
export interface Side {
  normal: Vector3; // unit vector
  offset: number; // [m]
}

/// The four sides of a picture of this ratio of width to height, for points from the point looked at.
export function sidesOf(values: CameraValues, aspect: number): Side[] {
  const [right, up, back] = [new Vector3(), new Vector3(), new Vector3()];
  cameraAxes(values, right, up, back);
  const high = halfHeight(values.zoom, aspect);
  const side = (across: Vector3, sign: number, half: number): Side => {
    const size = Math.hypot(1, half);
    return { normal: back.clone().multiplyScalar(-half).addScaledVector(across, sign).divideScalar(size), offset: (half * values.distance) / size };
  };
  return [side(right, 1, high * aspect), side(right, -1, high * aspect), side(up, 1, high), side(up, -1, high)];
}

/// At least 1 and at most `most`, with two digits. What is outside at 1 already cannot be brought into the picture, and does not count.
export function largestExaggeration(sides: Side[], movers: Mover[], most: number): number {
  let largest = most;
  for (const { start, moved, radius } of movers) {
    const room = sides.map(({ normal, offset }) => normal.dot(start) + offset - radius);
    const rates = sides.map(({ normal }) => normal.dot(moved));
    if (room.some((each, i) => each + rates[i] < 0)) continue;
    rates.forEach((rate, i) => {
      if (rate < 0) largest = Math.min(largest, room[i] / -rate);
    });
  }
  const unit = 10 ** (Math.floor(Math.log10(largest)) - 1);
  return Math.max(1, Math.floor(largest / unit + 1e-9) * unit);
}

/// Where at the edge of a picture an arrow points to what has left it.
export interface EdgePlace {
  x: number; // [CSS pixels]
  y: number;
  angle: number; // of the arrow, clockwise from the right [rad]
}

/// For a point in normalised coordinates of the picture, -1 to 1 to the right and upwards; null where it is inside. A point behind the
/// camera is seen by its mirror image.
export function edgePlace(across: number, upwards: number, behind: boolean, width: number, height: number, margin: number): EdgePlace | null {
  if (!behind && Math.abs(across) <= 1 && Math.abs(upwards) <= 1) return null;
  const sign = behind ? -1 : 1;
  const [dx, dy] = [(sign * across * width) / 2, (-sign * upwards * height) / 2];
  const part = Math.min((width / 2 - margin) / Math.abs(dx), (height / 2 - margin) / Math.abs(dy));
  return { x: width / 2 + part * dx, y: height / 2 + part * dy, angle: Math.atan2(dy, dx) };
}
