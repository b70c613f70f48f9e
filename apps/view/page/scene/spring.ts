// The spring between a point of a body and the pointer that drags it.
import { type Color, type Ray, Vector3 } from "three";
import { Dots } from "./dots.ts";
import { onPlane } from "./pull.ts";
import type { Stage } from "./stage.ts";
import { Strokes } from "./strokes.ts";

export class Spring {
  readonly strokes = new Strokes({ onTop: true, order: 40 });
  readonly ends: Dots;
  readonly target = new Vector3(); // as drawn
  body = -1; // none
  private readonly point = new Vector3(); // in the body's axes
  private readonly drawn = new Vector3();

  constructor(rim: Color) {
    this.ends = new Dots("ring", rim, { onTop: true, order: 41 });
  }
  get held(): boolean {
    return this.body >= 0;
  }
  start(body: number, point: Vector3, target: Vector3): void {
    this.body = body;
    this.point.copy(point);
    this.target.copy(target);
  }
  /// `back` is the picture's normal.
  move(stage: Stage, ray: Ray, back: Vector3): boolean {
    return onPlane(ray, this.end(stage), back, this.target);
  }
  release(): void {
    this.body = -1;
  }
  /// The end on the body, as drawn.
  private end(stage: Stage): Vector3 {
    return stage.fromBody(0, this.body, this.drawn.copy(this.point));
  }
  /// Where the pointer is in the world: as far from the body's point as it is drawn from it.
  realTarget(stage: Stage): Vector3 {
    return stage.realPoint(0, this.body, this.point, new Vector3()).add(this.target).sub(this.end(stage));
  }
  stretch(stage: Stage): number {
    return this.end(stage).distanceTo(this.target);
  }
  fill(stage: Stage, colour: Color): void {
    this.strokes.begin();
    this.ends.begin();
    if (this.held && stage.snapshot) {
      this.strokes.add(this.end(stage), this.target, colour, 2);
      for (const each of [this.drawn, this.target]) this.ends.add(each.x, each.y, each.z, colour, 9);
    }
    this.strokes.end();
    this.ends.end();
  }
  dispose(): void {
    this.strokes.dispose();
    this.ends.dispose();
  }
}
