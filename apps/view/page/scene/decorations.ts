// What is known of bodies beside their shapes: frames, centres of mass, inertia, joint axes, sensors, boundary points. Of the run
// itself, not of ghosts.
import { type Color, Color as Colour, Group, Vector3 } from "three";
import { axisColours, mix, type Palette } from "./colours.ts";
import { Dots } from "./dots.ts";
import { inertiaBox, type InertiaBox } from "./inertia.ts";
import type { Stage } from "./stage.ts";
import { Strokes } from "./strokes.ts";
import type { Switch } from "./switches.ts";

const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
const corners = [-0.5, 0.5]; // of a box with edges 1
const bars = [-0.75, 0.75]; // of a prismatic joint's axis, in its length

export class Decorations {
  readonly group = new Group();
  private readonly strokes = new Strokes({ onTop: true, order: 33 });
  private readonly quartered: Dots;
  private readonly diamonds: Dots;
  private readonly discs: Dots;
  private readonly boxes: (InertiaBox | null)[];
  private readonly axes = axisColours.map((each) => new Colour(each));
  private readonly joint = new Colour();
  private readonly inertia = new Colour();
  private readonly dark = new Colour("#111111"); // the mark of a centre of mass is black and white on every page
  private readonly bright = new Colour("#ffffff");
  private readonly point = new Colour();
  private readonly sensor = new Colour("#b07d00");

  constructor(
    private readonly stage: Stage,
    rim: Color,
  ) {
    this.boxes = stage.description.scene.bodies.map((body) => inertiaBox(body.mass, body.inertia));
    this.quartered = new Dots("quartered", this.dark, { onTop: true, order: 35 });
    this.diamonds = new Dots("diamond", rim, { onTop: true, order: 35 });
    this.discs = new Dots("disc", rim, { onTop: true, order: 34 });
    this.group.add(this.strokes.mesh, this.quartered.points, this.diamonds.points, this.discs.points);
  }
  get strokeLayer(): Strokes {
    return this.strokes;
  }
  get dotLayers(): Dots[] {
    return [this.quartered, this.diamonds, this.discs];
  }
  paint(palette: Palette): void {
    this.joint.copy(mix(palette.ink, "#d55e00", 0.8));
    this.inertia.copy(mix(palette.ink, "#8a3ffc", 0.6));
    this.point.copy(mix(palette.ink, palette.page, 0.25));
  }

  fill(show: Record<Switch, boolean>): void {
    const { bodies, sensors } = this.stage.description.scene;
    const layers = [this.strokes, ...this.dotLayers];
    for (const layer of layers) layer.begin();
    if (this.stage.snapshot && this.stage.visible[0]) {
      const length = 0.18 * this.stage.radius;
      bodies.forEach((body, k) => {
        if (show.frames) this.frame(k, length);
        if (show.joint_axes && body.joint) this.jointAxis(k, body.joint, length);
        if (show.inertia) this.inertiaEdges(k);
        if (show.centers_of_mass && body.mass > 0) {
          this.world(k, a.fromArray(body.center_of_mass));
          this.quartered.add(a.x, a.y, a.z, this.bright, 13);
        }
        if (!show.boundary_points) return;
        for (const point of body.points) {
          this.world(k, a.fromArray(point));
          this.discs.add(a.x, a.y, a.z, this.point, 5);
        }
      });
      if (show.sensors)
        for (const sensor of sensors) {
          this.world(sensor.body, a.fromArray(sensor.location));
          this.diamonds.add(a.x, a.y, a.z, this.sensor, 14);
        }
    }
    for (const layer of layers) layer.end();
  }
  private world(body: number, point: Vector3): Vector3 {
    return this.stage.fromBody(0, body, point);
  }
  private frame(body: number, length: number): void {
    this.world(body, a.set(0, 0, 0));
    for (let axis = 0; axis < 3; ++axis) {
      this.world(body, b.set(0, 0, 0).setComponent(axis, length));
      this.strokes.add(a, b, this.axes[axis], 2);
    }
  }
  /// A line along the body's z; a ring about it where the joint turns, cross-bars where it slides.
  private jointAxis(body: number, joint: "revolute" | "prismatic", length: number): void {
    this.strokes.add(
      this.world(body, a.set(0, 0, -0.75 * length)), this.world(body, b.set(0, 0, 0.75 * length)), this.joint, 2);
    const radius = 0.22 * length;
    if (joint === "revolute") {
      const steps = 16;
      this.world(body, a.set(radius, 0, 0));
      for (let step = 1; step <= steps; ++step) {
        const angle = (2 * Math.PI * step) / steps;
        this.world(body, b.set(radius * Math.cos(angle), radius * Math.sin(angle), 0));
        this.strokes.add(a, b, this.joint, 2);
        a.copy(b);
      }
      return;
    }
    for (const side of bars)
      this.strokes.add(
        this.world(body, a.set(-radius, 0, side * length)), this.world(body, b.set(radius, 0, side * length)), this.joint, 2);
  }
  private inertiaEdges(body: number): void {
    const box = this.boxes[body];
    if (!box) return;
    const { center_of_mass } = this.stage.description.scene.bodies[body];
    const place = (point: Vector3) =>
      this.world(body, point.multiply(box.edges).applyQuaternion(box.orientation).add(c.fromArray(center_of_mass)));
    for (let axis = 0; axis < 3; ++axis)
      for (const i of corners)
        for (const j of corners) {
          a.setComponent(axis, -0.5).setComponent((axis + 1) % 3, i).setComponent((axis + 2) % 3, j);
          b.copy(a).setComponent(axis, 0.5);
          this.strokes.add(place(a), place(b), this.inertia, 1.5);
        }
  }
  dispose(): void {
    this.strokes.dispose();
    for (const layer of this.dotLayers) layer.dispose();
  }
}
