// Dragging a body: the target moves in the plane through the point taken, parallel to the picture.
import type { Ray, Vector3 } from "three";

/// Where a ray meets the plane through `point` with unit normal `normal`; false where it does not.
export function onPlane(ray: Ray, point: Vector3, normal: Vector3, out: Vector3): boolean {
  const slope = ray.direction.dot(normal);
  if (Math.abs(slope) < 1e-9) return false;
  const distance = out.copy(point).sub(ray.origin).dot(normal) / slope;
  if (!(distance > 0)) return false;
  out.copy(ray.origin).addScaledVector(ray.direction, distance);
  return true;
}
