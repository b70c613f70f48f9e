// What all layers of a scene are drawn from: the poses as drawn, of every subject, and where a point of the world is drawn.
import { Matrix4, Vector3 } from "three";
import type { Body, Description, Snapshot } from "../protocol.ts";
import { exaggeratePose, magnifyDisplacement } from "./exaggeration.ts";
import type { Mover } from "./fitting.ts";
import { placeMatrix } from "./robots.ts";
import type { Ground } from "./terrain.ts";
import { trianglesOf } from "./shapes.ts";

export const numbersOfContact = 12;

const leastTiles = 0.3; // of the ground's tiles, in the radius of a picture, unless bodies would be specks
const rounding = 1e-12; // of poses [m and 1]
const mostSurround = 4; // radii of the robots, which are to be seen among their obstacles and on their tiles

export class Stage {
  snapshot: Snapshot | null = null;
  exaggeration = 1;
  /// Whether only what happens along the ground is exaggerated.
  alongGround = true;
  readonly visible: boolean[];
  readonly drawn: Float64Array[]; // poses, of each subject
  readonly center = new Vector3(); // of the robots where they started; of all bodies where there is no robot
  radius = 1; // of a ball around them [m]
  surround = 1; // radius of a ball around the same place that holds obstacles too, as far as they are near [m]
  fitting = 1; // radius of a ball there that a picture should hold: chains that swing, and some of the ground [m]
  readonly weight: number; // of the heaviest robot [N]
  private readonly starts: Float64Array[];
  private readonly reaches: number[]; // of each body, from its joint [m]
  private started = false;
  private told = false; // whether the description has the start poses
  private readonly normals: Vector3[] = []; // of the ground under each body's robot

  constructor(
    readonly description: Description,
    private readonly ground: Ground | null,
  ) {
    const { bodies, gravity } = description.scene;
    const numbers = 7 * bodies.length;
    this.drawn = description.subjects.map(() => new Float64Array(numbers));
    this.starts = description.subjects.map(() => new Float64Array(numbers));
    this.visible = description.subjects.map(() => true);
    this.reaches = bodies.map(reachOf);
    const masses = new Map<number, number>();
    for (const body of bodies) masses.set(body.robot, (masses.get(body.robot) ?? 0) + body.mass);
    const starts = bodies.map((body) => body.start);
    if (bodies.length > 0 && starts.every((each) => each !== undefined)) {
      for (const each of this.starts) each.set(starts.flat());
      this.told = true;
    }
    this.weight = Math.max(0, ...masses.values()) * Math.hypot(...gravity);
  }

  /// How far from the world's origin a body is drawn [m]: one that creeps may have left the terrain.
  get farthest(): number {
    let farthest = 0;
    for (const poses of this.drawn)
      for (let at = 0; at < poses.length; at += 7) {
        const distance = Math.hypot(poses[at], poses[at + 1], poses[at + 2]);
        if (distance > farthest && distance < Infinity) farthest = distance;
      }
    return farthest;
  }
  /// Of a body's origin since the start, as it is and not as it is drawn.
  displacement(subject: number, body: number, out: Vector3): Vector3 {
    const [now, start] = [this.snapshot!.subjects[subject].poses, this.starts[subject]];
    return out.set(now[7 * body] - start[7 * body], now[7 * body + 1] - start[7 * body + 1], now[7 * body + 2] - start[7 * body + 2]);
  }
  /// Displacements are measured from these poses.
  start(snapshot: Snapshot): void {
    snapshot.subjects.forEach((subject, k) => this.starts[k]?.set(subject.poses));
    this.started = true;
    this.measure();
  }
  private measure(): void {
    const { bodies } = this.description.scene;
    const [least, greatest] = [new Vector3(Infinity, Infinity, Infinity), new Vector3(-Infinity, -Infinity, -Infinity)];
    const [matrix, corner] = [new Matrix4(), new Vector3()];
    const around = new Map<number, { sum: Vector3; count: number }>();
    const robots = bodies.some((body) => body.robot >= 0);
    const corners: Vector3[] = []; // of obstacles
    const balls = this.swings();
    // An obstacle is by itself.
    const owner = (body: Body, k: number) => (body.robot < 0 ? -1 - k : body.robot);
    bodies.forEach((body, k) => {
      placeMatrix(matrix, this.starts[0], k);
      const { positions } = trianglesOf(body.shapes);
      if (positions.length === 0) positions.push(0, 0, 0);
      for (let at = 0; at < positions.length; at += 3) {
        corner.fromArray(positions, at).applyMatrix4(matrix);
        if (robots && body.robot < 0) {
          corners.push(corner.clone());
          continue;
        }
        least.min(corner);
        greatest.max(corner);
      }
      const robot = around.get(owner(body, k)) ?? { sum: new Vector3(), count: 0 };
      robot.sum.add(corner.setFromMatrixPosition(matrix));
      ++robot.count;
      around.set(owner(body, k), robot);
    });
    if (bodies.length > 0) {
      this.radius = Math.max(greatest.distanceTo(least) / 2, 1e-6);
      for (const { center, radius } of balls) {
        least.min(corner.copy(center).subScalar(radius));
        greatest.max(corner.copy(center).addScalar(radius));
      }
      this.center.addVectors(least, greatest).multiplyScalar(0.5);
    }
    this.surround = this.radius;
    for (const each of corners)
      this.surround = Math.max(this.surround, Math.min(each.distanceTo(this.center), mostSurround * this.radius));
    this.fitting = Math.max(this.surround, Math.min(leastTiles * (this.ground?.spacing ?? 0), mostSurround * this.radius));
    for (const each of balls) this.fitting = Math.max(this.fitting, each.center.distanceTo(this.center) + each.radius);
    const up = new Vector3(...this.description.scene.gravity).negate();
    if (up.length() === 0) up.set(0, 0, 1);
    const ofRobot = new Map<number, Vector3>();
    for (const [robot, { sum, count }] of around)
      ofRobot.set(robot, this.ground ? this.ground.normalAt(sum.x / count, sum.y / count) : up.clone().normalize());
    this.normals.length = 0;
    bodies.forEach((body, k) => this.normals.push(ofRobot.get(owner(body, k))!));
  }

  /// Balls that hold all that chains can reach whose bases stand still: of a base's joint and the links' lengths.
  private swings(): { center: Vector3; radius: number }[] {
    const { bodies } = this.description.scene;
    const joints = bodies.map((_, k) => new Vector3().setFromMatrixPosition(placeMatrix(new Matrix4(), this.starts[0], k)));
    const lengths: number[] = []; // along the chain, to each body's joint
    const balls = new Map<number, { center: Vector3; radius: number }>();
    bodies.forEach((body, k) => {
      const free = body.robot < 0 || (body.parent < 0 && body.mass > 0);
      lengths.push(free ? NaN : body.parent < 0 ? 0 : lengths[body.parent] + joints[k].distanceTo(joints[body.parent]));
      if (Number.isNaN(lengths[k])) return;
      if (body.parent < 0) balls.set(body.robot, { center: joints[k], radius: 0 });
      const ball = balls.get(body.robot);
      if (ball !== undefined) ball.radius = Math.max(ball.radius, lengths[k] + reachOf(body));
    });
    return [...balls.values()];
  }

  take(snapshot: Snapshot): void {
    if (!this.started && this.told) {
      this.started = true;
      this.measure();
    } else if (!this.started || (!this.told && snapshot.step === 0 && !snapshot.past && this.snapshot?.step !== 0)) {
      this.start(snapshot);
    }
    if (this.startsElsewhere(snapshot)) this.start(snapshot);
    this.snapshot = snapshot;
  }
  /// Whether the run begins at another pose than before: a person set one.
  private startsElsewhere(snapshot: Snapshot): boolean {
    return snapshot.step === 0 && !snapshot.past &&
      snapshot.subjects.some(({ poses }, k) => poses.some((value, at) => Math.abs(value - this.starts[k][at]) > rounding));
  }
  /// Bodies of the robots of what is visible, as an exaggeration moves them; their places are from `origin`, which moves by `carried`.
  movers(origin: Vector3, carried: Vector3): Mover[] {
    const { bodies } = this.description.scene;
    const movers: Mover[] = [];
    this.snapshot?.subjects.forEach((subject, k) => {
      if (!this.visible[k] || !subject.fine) return;
      bodies.forEach((body, i) => {
        if (body.robot < 0) return;
        const moved = this.displacement(k, i, new Vector3());
        const start = new Vector3(...this.starts[k].subarray(7 * i, 7 * i + 3)).sub(origin);
        const across = this.acrossGround(i, moved);
        movers.push({ start: start.add(across), moved: moved.sub(across).sub(carried), radius: this.reaches[i] });
      });
    });
    return movers;
  }
  /// The part of a displacement that is not exaggerated.
  private acrossGround(body: number, displacement: Vector3): Vector3 {
    const normal = this.normal(body);
    return normal === null ? new Vector3() : normal.clone().multiplyScalar(normal.dot(displacement));
  }
  /// The displacement of a body that an exaggeration magnifies.
  magnified(subject: number, body: number): Vector3 {
    const moved = this.displacement(subject, body, new Vector3());
    return moved.sub(this.acrossGround(body, moved));
  }
  private normal(body: number): Vector3 | null {
    return this.alongGround ? this.normals[body] : null;
  }
  /// Computes `drawn` from the newest snapshot.
  pose(): void {
    this.snapshot?.subjects.forEach((subject, k) => {
      const out = this.drawn[k];
      if (!out) return;
      for (let body = 0; 7 * body < out.length; ++body)
        exaggeratePose(out, subject.poses, this.starts[k], 7 * body, this.exaggeration, this.normal(body));
    });
  }

  /// Where a point of a body is drawn that is at x, y, z in the world.
  drawnPoint(subject: number, body: number, x: number, y: number, z: number, out: Vector3): Vector3 {
    out.set(x, y, z);
    if (this.exaggeration === 1 || !this.snapshot) return out;
    placeMatrix(matrixOfBody, this.snapshot.subjects[subject].poses, body);
    out.applyMatrix4(matrixOfBody.invert());
    return out.applyMatrix4(placeMatrix(matrixOfBody, this.drawn[subject], body));
  }
  /// From a body's axes to where it is drawn.
  fromBody(subject: number, body: number, point: Vector3): Vector3 {
    return point.applyMatrix4(placeMatrix(matrixOfBody, this.drawn[subject], body));
  }
  /// Where a point of a body is in the world, given in the body's axes.
  realPoint(subject: number, body: number, point: Vector3, out: Vector3): Vector3 {
    return out.copy(point).applyMatrix4(placeMatrix(matrixOfBody, this.snapshot!.subjects[subject].poses, body));
  }
  /// From where it is drawn to a body's axes.
  toBody(subject: number, body: number, point: Vector3): Vector3 {
    return point.applyMatrix4(placeMatrix(matrixOfBody, this.drawn[subject], body).invert());
  }
  /// The displacement of a point of a body, as it is drawn at `factor`.
  magnify(body: number, displacement: Vector3, factor: number): void {
    magnifyDisplacement(displacement, factor, this.normal(body));
  }
}

const matrixOfBody = new Matrix4();

/// Of a body's joint to the farthest corner of its shapes [m].
function reachOf(body: Body): number {
  const { positions } = trianglesOf(body.shapes);
  let reach = 0;
  for (let at = 0; at < positions.length; at += 3) reach = Math.max(reach, Math.hypot(positions[at], positions[at + 1], positions[at + 2]));
  return reach;
}
