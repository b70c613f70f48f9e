// What happens at the contacts: forces as arrows, hooks and their stretch, depths as colours.
import { CylinderGeometry, DynamicDrawUsage, Group, InstancedMesh, type Color, Matrix4, Quaternion, type ShaderMaterial, Vector3 } from "three";
import { depthColour, mix, type Palette } from "./colours.ts";
import { Dots } from "./dots.ts";
import { type Light, matteMaterial } from "./matte.ts";
import { numbersOfContact, type Stage } from "./stage.ts";
import { Strokes } from "./strokes.ts";

const up = new Vector3(0, 1, 0);
const [point, force, hook, middle, size] = [new Vector3(), new Vector3(), new Vector3(), new Vector3(), new Vector3()];
const matrix = new Matrix4();
const turn = new Quaternion();

/// Arrows from each point along the force on the robot: shafts and heads, two draw calls.
export class ForceArrows {
  readonly group = new Group();
  private shafts: InstancedMesh;
  private heads: InstancedMesh;
  private readonly material: ShaderMaterial;
  private capacity = 64;
  private colours: Color[] = [];

  constructor(light: Light) {
    this.material = matteMaterial(light, false);
    this.material.transparent = true; // after the ghosts
    [this.shafts, this.heads] = this.make();
  }
  private make(): [InstancedMesh, InstancedMesh] {
    const both = [new CylinderGeometry(1, 1, 1, 10), new CylinderGeometry(0, 1, 1, 14)].map((geometry) => {
      const mesh = new InstancedMesh(geometry, this.material, this.capacity);
      mesh.instanceMatrix.setUsage(DynamicDrawUsage);
      mesh.frustumCulled = false;
      mesh.count = 0;
      mesh.renderOrder = 20;
      this.group.add(mesh);
      return mesh;
    });
    // Forces are seen through what stands before them, but not through each other.
    both[0].onBeforeRender = (renderer) => renderer.clearDepth();
    return [both[0], both[1]];
  }
  paint(palette: Palette, stage: Stage): void {
    this.colours = stage.description.subjects.map(({ colour }, k) => mix(colour, palette.ink, k === 0 ? 0.85 : 0.25));
  }
  /// `length` is that of one body weight [m].
  fill(stage: Stage, length: number): void {
    let count = 0;
    const subjects = stage.snapshot?.subjects ?? [];
    const all = subjects.reduce((sum, each) => sum + each.contacts.length / numbersOfContact, 0);
    if (all > this.capacity) {
      this.free();
      this.capacity = 2 * all;
      [this.shafts, this.heads] = this.make();
    }
    const radius = 0.012 * length;
    for (let k = 0; k < subjects.length; ++k) {
      if (!stage.visible[k]) continue;
      const { contacts } = subjects[k];
      for (let at = 0; at < contacts.length; at += numbersOfContact) {
        force.fromArray(contacts, at + 4).multiplyScalar(stage.weight > 0 ? length / stage.weight : 0);
        const long = force.length();
        if (!(long > 0.005 * length)) continue;
        stage.drawnPoint(k, contacts[at], contacts[at + 1], contacts[at + 2], contacts[at + 3], point);
        force.multiplyScalar(1 / long);
        turn.setFromUnitVectors(up, force);
        const head = Math.min(7 * radius, 0.6 * long);
        middle.copy(point).addScaledVector(force, (long - head) / 2);
        this.shafts.setMatrixAt(count, matrix.compose(middle, turn, size.set(radius, long - head, radius)));
        middle.copy(point).addScaledVector(force, long - head / 2);
        this.heads.setMatrixAt(count, matrix.compose(middle, turn, size.set(head * 0.4, head, head * 0.4)));
        this.shafts.setColorAt(count, this.colours[k]);
        this.heads.setColorAt(count, this.colours[k]);
        ++count;
      }
    }
    for (const mesh of [this.shafts, this.heads]) {
      mesh.count = count;
      mesh.instanceMatrix.needsUpdate = true;
      if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    }
  }
  private free(): void {
    for (const mesh of [this.shafts, this.heads]) {
      this.group.remove(mesh);
      mesh.geometry.dispose();
      mesh.dispose();
    }
  }
  dispose(): void {
    this.free();
    this.material.dispose();
  }
}

/// Anchors on the ground and lines to the points that hang on them. The stretch, of micrometres mostly, is drawn `factor` times.
export class Hooks {
  readonly strokes = new Strokes({ onTop: true, order: 30 });
  readonly anchors: Dots;
  private colours: Color[] = [];

  constructor(rim: Color) {
    this.anchors = new Dots("ring", rim, { onTop: true, order: 31 });
  }
  paint(palette: Palette, stage: Stage): void {
    this.colours = stage.description.subjects.map(({ colour }) => mix(colour, palette.ink, 0.45));
  }
  fill(stage: Stage, factor: number): void {
    this.strokes.begin();
    this.anchors.begin();
    stage.snapshot?.subjects.forEach(({ contacts }, k) => {
      if (!stage.visible[k]) return;
      for (let at = 0; at < contacts.length; at += numbersOfContact) {
        const body = contacts[at];
        stage.drawnPoint(k, body, contacts[at + 1], contacts[at + 2], contacts[at + 3], point);
        hook.set(contacts[at + 7] - contacts[at + 1], contacts[at + 8] - contacts[at + 2], contacts[at + 9] - contacts[at + 3]);
        stage.magnify(body, hook, factor);
        hook.add(point);
        this.strokes.add(hook, point, this.colours[k], 2);
        this.anchors.add(hook.x, hook.y, hook.z, this.colours[k], 8);
      }
    });
    this.strokes.end();
    this.anchors.end();
  }
  dispose(): void {
    this.strokes.dispose();
    this.anchors.dispose();
  }
}

/// The least of 1, 2, 5, 10... not below a value: scales keep still while what they show changes.
export function roundScale(value: number): number {
  const decade = 10 ** Math.floor(Math.log10(value));
  const steps = [1, 2, 5, 10].map((step) => step * decade);
  return steps.find((step) => step >= value * (1 - 1e-12)) ?? 10 * decade;
}

const rampSteps = 63;

/// Points in the ground, coloured by depth. The scale only ever grows.
export class Penetration {
  readonly dots: Dots;
  scale = 1e-6; // deepest of the colour bar [m]
  private readonly ramp: Color[] = [];

  constructor(rim: Color) {
    this.dots = new Dots("disc", rim, { onTop: true, order: 32 });
  }
  paint(palette: Palette): void {
    for (let step = 0; step <= rampSteps; ++step) this.ramp[step] = depthColour(step / rampSteps, palette);
  }
  fill(stage: Stage): void {
    this.dots.begin();
    stage.snapshot?.subjects.forEach(({ contacts }, k) => {
      if (!stage.visible[k]) return;
      for (let at = 0; at < contacts.length; at += numbersOfContact) {
        const depth = contacts[at + 10];
        if (!(depth > 0)) continue;
        if (depth > this.scale) this.scale = roundScale(depth);
        stage.drawnPoint(k, contacts[at], contacts[at + 1], contacts[at + 2], contacts[at + 3], point);
        this.dots.add(point.x, point.y, point.z, this.ramp[Math.round((rampSteps * depth) / this.scale)], 9);
      }
    });
    this.dots.end();
  }
  dispose(): void {
    this.dots.dispose();
  }
}
