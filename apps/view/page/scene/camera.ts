// Where a camera stands. At euler1 = euler2 = 0 it looks along +y, x to the right and z up. euler1 carries it about the world's z
// through the point looked at, counter-clockwise seen from above; euler2 lifts it above the horizon.
import { MathUtils, Matrix4, type PerspectiveCamera, Vector3 } from "three";

export interface CameraValues {
  zoom: number; // magnification
  distance: number; // from the point looked at [m]
  euler1: number; // [rad]
  euler2: number; // [rad]
}

export const defaultCamera: Readonly<CameraValues> = { zoom: 1, distance: 3, euler1: 0.6, euler2: 0.4 };

/// What the shorter side of the picture spans at zoom 1 [rad].
export const fieldOfView = MathUtils.degToRad(40);

/// Unit vectors of the picture: right, up, and from the point looked at back to the camera. They have no pole: the camera may pass
/// over the top.
export function cameraAxes(values: CameraValues, right: Vector3, up: Vector3, back: Vector3): void {
  const { euler1, euler2 } = values;
  right.set(Math.cos(euler1), Math.sin(euler1), 0);
  back.set(Math.sin(euler1) * Math.cos(euler2), -Math.cos(euler1) * Math.cos(euler2), Math.sin(euler2));
  up.crossVectors(back, right);
}

/// Half the height of the picture at unit distance.
export function halfHeight(zoom: number, aspect: number): number {
  return Math.tan(fieldOfView / 2) / zoom / Math.min(aspect, 1);
}

const right = new Vector3();
const up = new Vector3();
const back = new Vector3();
const axes = new Matrix4();

/// `reach` is how far from the point looked at there is something to see [m].
export function placeCamera(
  camera: PerspectiveCamera,
  values: CameraValues,
  target: Vector3,
  aspect: number,
  reach: number,
): void {
  cameraAxes(values, right, up, back);
  camera.quaternion.setFromRotationMatrix(axes.makeBasis(right, up, back));
  camera.position.copy(target).addScaledVector(back, values.distance);
  camera.fov = MathUtils.radToDeg(2 * Math.atan(halfHeight(values.zoom, aspect)));
  camera.aspect = aspect;
  camera.near = values.distance / 100;
  camera.far = Math.min(values.distance + reach, 1e4 * values.distance) + values.distance;
  camera.updateProjectionMatrix();
  camera.updateMatrixWorld();
}

/// The distance from which a ball of this radius fills the picture.
export function fittingDistance(radius: number, zoom: number): number {
  return radius / Math.sin(Math.atan(Math.tan(fieldOfView / 2) / zoom));
}

/// Pixels that a metre takes at the point looked at, in a picture of this height.
export function pixelsPerMetre(values: CameraValues, width: number, height: number): number {
  return height / (2 * values.distance * halfHeight(values.zoom, width / height));
}

const leastDistance = 1e-3;
const greatestDistance = 1e4;

export function orbited(values: CameraValues, turn: number, lift: number): CameraValues {
  const highest = Math.PI / 2;
  return { ...values, euler1: values.euler1 + turn, euler2: MathUtils.clamp(values.euler2 + lift, -highest, highest) };
}
export function moved(values: CameraValues, factor: number): CameraValues {
  return { ...values, distance: MathUtils.clamp(values.distance * factor, leastDistance, greatestDistance) };
}
export function zoomed(values: CameraValues, factor: number): CameraValues {
  return { ...values, zoom: MathUtils.clamp(values.zoom * factor, 0.05, 200) };
}
