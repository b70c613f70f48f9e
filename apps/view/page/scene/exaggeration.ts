// Displacements drawn larger than they are, so that creep is seen. A pose is drawn at p0 + e (p - p0), turned by e times its rotation
// since the start: each point of a body then moves e times as far as it did, and links stay joined, as long as the angle drawn is
// small. No rotation is drawn beyond `largestAngle`, unless it is as large itself: a point on a circle is not on its tangent.
//
// With a `normal`, only what happens along the ground is exaggerated. A body that settles 0.1 mm into its springs would otherwise be
// drawn 10 m below the ground at e = 1e5.
import { Quaternion, Vector3 } from "three";

export const largestAngle = 1; // [rad]

const displacement = new Vector3();
const turn = new Vector3();
const part = new Vector3();
const rotation = new Quaternion();
const startRotation = new Quaternion();

/// The rotation vector of a unit quaternion, of at most a half turn.
export function rotationVector(of: Quaternion, out: Vector3): Vector3 {
  const sign = of.w < 0 ? -1 : 1;
  out.set(of.x, of.y, of.z).multiplyScalar(sign);
  const sine = out.length();
  // For small angles the sine is exact where 1 - w would have lost all digits.
  return sine === 0 ? out : out.multiplyScalar((2 * Math.atan2(sine, sign * of.w)) / sine);
}

function magnify(vector: Vector3, factor: number, limit: number): void {
  const length = vector.length();
  if (length > 0) vector.multiplyScalar(Math.max(length, Math.min(factor * length, limit)) / length);
}

/// Takes the part of `vector` along (`along`) or across `normal` away and magnifies it.
function magnifyPart(vector: Vector3, normal: Vector3, along: boolean, factor: number, limit: number): void {
  part.copy(normal).multiplyScalar(normal.dot(vector));
  if (!along) part.subVectors(vector, part);
  vector.sub(part);
  magnify(part, factor, limit);
  vector.add(part);
}

/// The displacement of a point, as it is drawn.
export function magnifyDisplacement(vector: Vector3, factor: number, normal: Vector3 | null): void {
  if (normal) magnifyPart(vector, normal, false, factor, Infinity);
  else vector.multiplyScalar(factor);
}

/// Writes the pose drawn for the one at `at` of `poses` (x y z qw qx qy qz).
export function exaggeratePose(
  out: Float64Array,
  poses: Float64Array,
  starts: Float64Array,
  at: number,
  factor: number,
  normal: Vector3 | null,
): void {
  if (factor === 1) {
    for (let k = at; k < at + 7; ++k) out[k] = poses[k];
    return;
  }
  displacement.set(poses[at] - starts[at], poses[at + 1] - starts[at + 1], poses[at + 2] - starts[at + 2]);
  magnifyDisplacement(displacement, factor, normal);
  startRotation.set(starts[at + 4], starts[at + 5], starts[at + 6], starts[at + 3]);
  rotation.set(-starts[at + 4], -starts[at + 5], -starts[at + 6], starts[at + 3]);
  rotation.premultiply(orientationAt(poses, at));
  rotationVector(rotation, turn);
  if (normal) magnifyPart(turn, normal, true, factor, largestAngle);
  else magnify(turn, factor, largestAngle);
  const angle = turn.length();
  if (angle > 0) rotation.setFromAxisAngle(turn.multiplyScalar(1 / angle), angle).multiply(startRotation);
  else rotation.copy(startRotation);
  out[at] = starts[at] + displacement.x;
  out[at + 1] = starts[at + 1] + displacement.y;
  out[at + 2] = starts[at + 2] + displacement.z;
  out[at + 3] = rotation.w;
  out[at + 4] = rotation.x;
  out[at + 5] = rotation.y;
  out[at + 6] = rotation.z;
}

const current = new Quaternion();
function orientationAt(poses: Float64Array, at: number): Quaternion {
  return current.set(poses[at + 4], poses[at + 5], poses[at + 6], poses[at + 3]);
}
