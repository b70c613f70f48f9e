// What all layers of a scene are drawn from: the poses as drawn, of every subject, and where a point of the world is drawn.
import { Matrix4, Vector3 } from "three";
import type { Description, Snapshot } from "../protocol.ts";
import { exaggeratePose, magnifyDisplacement } from "./exaggeration.ts";
import { placeMatrix } from "./robots.ts";
import type { Ground } from "./terrain.ts";
import { trianglesOf } from "./shapes.ts";

export const numbersOfContact = 12;

export class Stage {
  snapshot: Snapshot | null = null;
  exaggeration = 1;
  /// Whether only what happens along the ground is exaggerated.
  alongGround = true;
  readonly visible: boolean[];
  readonly drawn: Float64Array[]; // poses, of each subject
  readonly center = new Vector3(); // of the robots where they started
  radius = 1; // of a ball around the robots where they started [m]
  readonly weight: number; // of the heaviest robot [N]
  private readonly starts: Float64Array[];
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
    bodies.forEach((body, k) => {
      placeMatrix(matrix, this.starts[0], k);
      const { positions } = trianglesOf(body.shapes);
      if (positions.length === 0) positions.push(0, 0, 0);
      for (let at = 0; at < positions.length; at += 3) {
        corner.fromArray(positions, at).applyMatrix4(matrix);
        least.min(corner);
        greatest.max(corner);
      }
      const robot = around.get(body.robot) ?? { sum: new Vector3(), count: 0 };
      robot.sum.add(corner.setFromMatrixPosition(matrix));
      ++robot.count;
      around.set(body.robot, robot);
    });
    if (bodies.length > 0) {
      this.center.addVectors(least, greatest).multiplyScalar(0.5);
      this.radius = Math.max(greatest.distanceTo(least) / 2, 1e-6);
    }
    const up = new Vector3(...this.description.scene.gravity).negate();
    if (up.length() === 0) up.set(0, 0, 1);
    const ofRobot = new Map<number, Vector3>();
    for (const [robot, { sum, count }] of around)
      ofRobot.set(robot, this.ground ? this.ground.normalAt(sum.x / count, sum.y / count) : up.clone().normalize());
    this.normals.length = 0;
    for (const body of bodies) this.normals.push(ofRobot.get(body.robot)!);
  }

  take(snapshot: Snapshot): void {
    if (!this.started && this.told) {
      this.started = true;
      this.measure();
    } else if (!this.started || (!this.told && snapshot.step === 0 && !snapshot.past && this.snapshot?.step !== 0)) {
      this.start(snapshot);
    }
    this.snapshot = snapshot;
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
