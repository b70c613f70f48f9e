// How a camera that nobody placed keeps the robots in its picture: it goes with the first base that moves, gently, so that its
// bouncing is seen and not its picture's.
import { Vector3 } from "three";
import type { Body } from "../protocol.ts";

const timeConstant = 0.3; // of simulated time [s]
const mostLag = 0.3; // of the radius of what is in the picture

/// The first base that moves, or -1. A base that stands still has no mass.
export function firstMobileBase(bodies: Body[]): number {
  return bodies.findIndex((body) => body.robot >= 0 && body.parent < 0 && body.mass > 0);
}

/// Displacement since the start, smoothed by a first-order lag that never grows beyond a part of the picture.
export class Companion {
  readonly displacement = new Vector3();
  private time = NaN;

  follow(time: number, displacement: Vector3, radius: number): void {
    if (!Number.isFinite(displacement.lengthSq())) return;
    const passed = time - this.time;
    this.time = time;
    if (!(passed >= 0)) this.displacement.copy(displacement);
    else this.displacement.lerp(displacement, 1 - Math.exp(-passed / timeConstant));
    away.subVectors(this.displacement, displacement).clampLength(0, mostLag * radius);
    this.displacement.addVectors(displacement, away);
  }
}

const away = new Vector3();
