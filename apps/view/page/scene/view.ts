// One camera's picture of the world: a canvas in the page, the scene behind it, and what mouse and keys do to both.
import { Color, DirectionalLight, PerspectiveCamera, Quaternion, Raycaster, Scene, Vector2, Vector3 } from "three";
import type { Description, Snapshot } from "../protocol.ts";
import { type CameraValues, cameraAxes, defaultCamera, fittingDistance, halfHeight, pixelsPerMetre, placeCamera } from "./camera.ts";
import { css, type Palette, readPalette } from "./colours.ts";
import { Companion, firstMobileBase } from "./companion.ts";
import { ForceArrows, Hooks, Penetration } from "./contacts.ts";
import { Decorations } from "./decorations.ts";
import { figured } from "./figure.ts";
import { edgePlace, largestExaggeration, sidesOf } from "./fitting.ts";
import { type Gone, type Label, type Legends, lengthText, Overlay, shortNumber } from "./overlay.ts";
import { Light, sunward } from "./matte.ts";
import { Painter, type Quality } from "./painter.ts";
import { keysHelp, Pointer } from "./pointer.ts";
import { Robots } from "./robots.ts";
import { Spring } from "./spring.ts";
import { Stage } from "./stage.ts";
import { defaultSwitches, type Switch } from "./switches.ts";
import { Ground } from "./terrain.ts";
import { SlipTraces } from "./traces.ts";

export type Numbers3 = [number, number, number];
export interface Pick {
  body: number;
  point: Numbers3; // body axes
  world: Numbers3;
}
/// A body that stays in the middle; the robots, beside which the camera goes; null: nothing.
export type Followed = number | "robots" | null;
export interface CameraOptions {
  label?: string; // the accessible name
  camera?: Partial<CameraValues>;
  follow?: Followed;
  show?: Partial<Record<Switch, boolean>>;
  quality?: Quality;
}

/// A camera that the user just moved is not moved back by an older value of its ports; the newest is taken after this.
const settlingTime = 400; // [ms]
const greatestExaggeration = 1e6;
const edgeMargin = 16; // of an arrow's tip [CSS pixels]

export class CameraView {
  readonly canvas: HTMLCanvasElement;
  onCameraChange: (values: CameraValues) => void = () => {};
  onSelect: (body: number | null) => void = () => {};
  onPullStart: (body: number, point: Numbers3, target: Numbers3) => void = () => {};
  onPullMove: (target: Numbers3) => void = () => {};
  onPullEnd: () => void = () => {};
  /// Whether bodies can be pulled at.
  pulls = true;
  /// The force that the spring exerts, where it is known better than from its stretch [N].
  pullForce: number | null = null;

  private readonly context: CanvasRenderingContext2D;
  private readonly notice: HTMLParagraphElement;
  private readonly probe: HTMLSpanElement;
  private painter: Painter | null = null;
  private palette: Palette;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera();
  private readonly light = new Light();
  private readonly sun = new DirectionalLight(); // casts the shadows
  private readonly ground: Ground | null;
  private readonly stage: Stage;
  private readonly robots: Robots[];
  private readonly forces = new ForceArrows(this.light);
  private readonly rim = new Color(); // of marks
  private readonly hooks = new Hooks(this.rim);
  private readonly penetration = new Penetration(this.rim);
  private readonly traces = new SlipTraces(this.rim);
  private readonly decorations: Decorations;
  private readonly spring = new Spring(this.rim);
  private readonly overlay: Overlay;
  private readonly pointer: Pointer;
  private readonly caster = new Raycaster();
  private readonly shown = defaultSwitches();
  private values: CameraValues = { ...defaultCamera };
  private changedAt = -Infinity;
  private awaited: Partial<CameraValues> = {}; // of the ports, until the user's own movement has settled
  private settling = 0;
  private follow: Followed;
  private readonly companion = new Companion();
  private readonly mobile: number; // the base beside which it goes, or -1
  private readonly description: Description;
  private readonly offset = new Vector3(); // of the point looked at, by panning
  private readonly target = new Vector3();
  private selected = -1;
  private width = 0; // of the canvas in the page [CSS pixels]
  private height = 0;
  private frames = 0;
  private asked = 0;
  private wantedQuality: Quality;
  private hookFactor = 100;
  private readonly labels: Label[] = [];
  private readonly observer: ResizeObserver;
  private readonly scheme = matchMedia("(prefers-color-scheme: dark)");
  private readonly onScheme = (): void => this.repaint();
  private readonly onPainter = (): void => {
    const lost = "The browser has lost its graphics context. The picture stands still until it is back; everything else goes on.";
    this.tell(this.painter?.lost ? lost : "");
    this.changed();
  };

  constructor(
    private readonly host: HTMLElement,
    described: Description,
    options: CameraOptions = {},
  ) {
    const description = (this.description = { ...described, scene: { ...described.scene, bodies: figured(described.scene.bodies) } });
    this.canvas = document.createElement("canvas");
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "application");
    this.canvas.setAttribute("aria-roledescription", "camera");
    this.canvas.setAttribute("aria-label", `${options.label ?? `picture of ${description.world}`}. ${keysHelp}`);
    this.canvas.dataset.frames = "0";
    // Out of the flow: its size is the host's, never the other way round.
    this.canvas.style.cssText = "position:absolute;inset:0;width:100%;height:100%;touch-action:none";
    if (getComputedStyle(host).position === "static") host.style.position = "relative";
    this.notice = document.createElement("p");
    this.notice.setAttribute("role", "status");
    this.notice.style.cssText = "position:absolute;inset:auto 0;margin:0;padding:1em;background:var(--panel, Canvas)";
    this.probe = document.createElement("span");
    this.probe.hidden = true;
    host.append(this.canvas, this.notice, this.probe);
    const context = this.canvas.getContext("2d", { alpha: false });
    if (!context) throw new Error("this browser draws no canvas");
    this.context = context;

    this.wantedQuality = options.quality ?? "medium";
    this.follow = options.follow ?? null;
    this.mobile = firstMobileBase(description.scene.bodies);
    Object.assign(this.values, options.camera);
    Object.assign(this.shown, options.show);
    this.palette = readPalette(this.probe, description.scene.materials);
    this.overlay = new Overlay(this.palette);
    const { terrain, bodies } = description.scene;
    this.ground = terrain ? new Ground(terrain, this.light) : null;
    this.stage = new Stage(description, this.ground);
    this.robots = description.subjects.map((subject, k) => new Robots(bodies, subject, k, this.light, description.subjects.length - 1));
    this.decorations = new Decorations(this.stage, this.rim);
    this.build();
    this.repaint();
    this.takePainter();
    this.pointer = new Pointer(this.canvas, this.gestures());
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(host);
    this.scheme.addEventListener("change", this.onScheme);
    this.resize();
  }

  private build(): void {
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.radius = 2.5;
    this.scene.add(this.sun, this.sun.target);
    if (this.ground) this.scene.add(this.ground.group);
    for (const robot of this.robots) this.scene.add(robot.group);
    this.scene.add(
      this.forces.group, this.hooks.strokes.mesh, this.hooks.anchors.points, this.penetration.dots.points, this.traces.dots.points,
      this.decorations.group, this.spring.strokes.mesh, this.spring.ends.points,
    );
    for (const robot of this.robots) robot.group.visible = false; // until there are poses
    this.sizeLayers(1, 1, 1);
  }
  private takePainter(): void {
    try {
      this.painter = Painter.take(this.wantedQuality, this.onPainter);
      this.tell("");
    } catch {
      this.canvas.hidden = true;
      this.tell(
        "This browser gives no WebGL, so there is no picture of the scene here; everything else on this page works. " +
          "WebGL may be switched off in the browser's settings, or the graphics driver may be on the browser's block list.",
      );
    }
  }
  private tell(text: string): void {
    this.notice.hidden = text === "";
    this.notice.textContent = text;
  }

  // ---- what the page sets ----

  setCamera(values: Partial<CameraValues>): void {
    Object.assign(this.awaited, values);
    if (this.settling === 0) this.settle();
  }
  private settle(): void {
    this.settling = 0;
    const left = this.pointer.busy ? settlingTime : this.changedAt + settlingTime - performance.now();
    if (left > 0) {
      this.settling = window.setTimeout(() => this.settle(), left);
      return;
    }
    const values = this.awaited;
    this.awaited = {};
    let different = false;
    for (const name of ["zoom", "distance", "euler1", "euler2"] as const) {
      const value = values[name];
      if (value === undefined || !Number.isFinite(value) || value === this.values[name]) continue;
      if ((name === "zoom" || name === "distance") && value <= 0) continue;
      this.values[name] = value;
      different = true;
    }
    if (different) this.changed();
  }
  /// Its place is a person's for a moment: older values of its ports do not move it.
  hold(): void {
    this.changedAt = performance.now();
  }
  get cameraValues(): CameraValues {
    return { ...this.values };
  }
  setFollow(followed: Followed): void {
    this.follow = followed;
    this.offset.set(0, 0, 0);
    this.changed();
  }
  /// The switches; setting one draws anew.
  readonly show: Record<Switch, boolean> = new Proxy(this.shown, {
    set: (shown, name, value) => {
      shown[name as Switch] = value === true;
      this.changed();
      return true;
    },
  });
  get exaggeration(): number {
    return this.stage.exaggeration;
  }
  set exaggeration(factor: number) {
    this.stage.exaggeration = Math.min(Math.max(factor, 1), greatestExaggeration);
    this.newMeasure();
  }
  /// Whether only displacements along the ground are exaggerated, as at first, or all of them.
  get exaggerateAlongGround(): boolean {
    return this.stage.alongGround;
  }
  set exaggerateAlongGround(only: boolean) {
    this.stage.alongGround = only;
    this.newMeasure();
  }
  /// Displacements are measured from here; at first from the first snapshot, and from step 0 when that comes.
  setStart(snapshot: Snapshot): void {
    this.stage.start(snapshot);
    this.newMeasure();
  }
  private newMeasure(): void {
    this.traces.clear();
    this.stage.pose();
    this.changed();
  }
  /// How many times the hooks' stretch is drawn; never less than the displacements.
  get hookExaggeration(): number {
    return Math.max(this.hookFactor, this.stage.exaggeration);
  }
  set hookExaggeration(factor: number) {
    this.hookFactor = factor;
    this.changed();
  }
  setSubjectVisible(index: number, visible: boolean): void {
    this.stage.visible[index] = visible;
    this.changed();
  }
  get quality(): Quality {
    return this.wantedQuality;
  }
  set quality(quality: Quality) {
    const other = Painter.antialiases(quality) !== Painter.antialiases(this.wantedQuality);
    this.wantedQuality = quality;
    if (other && this.painter) {
      this.painter.leave(this.onPainter);
      this.painter = null;
      this.takePainter();
    }
    this.resize();
  }
  select(body: number | null): void {
    this.selected = body ?? -1;
    this.robots[0]?.select(this.selected);
    this.changed();
  }
  draw(snapshot: Snapshot): void {
    this.stage.take(snapshot);
    this.stage.pose();
    this.traces.take(this.stage);
    if (this.mobile >= 0) this.companion.follow(snapshot.time, this.stage.displacement(0, this.mobile, place), this.stage.fitting);
    this.changed();
  }
  /// The distance from which the robots, where they started, and what is near them fill the picture.
  get fittingDistance(): number {
    return fittingDistance(this.stage.fitting, this.values.zoom);
  }

  /// The largest exaggeration at which all bodies are in the picture, where the camera stands now.
  get fittingExaggeration(): number {
    if (!this.stage.snapshot || this.height === 0) return 1;
    const aspect = this.width / this.height;
    this.look(aspect);
    const carried = typeof this.follow === "number" ? this.stage.magnified(0, this.follow) : new Vector3();
    const origin = this.target.clone().addScaledVector(carried, -this.stage.exaggeration);
    return largestExaggeration(sidesOf(this.values, aspect), this.stage.movers(origin, carried), greatestExaggeration);
  }

  // ---- drawing ----

  private changed(): void {
    if (this.asked === 0) this.asked = requestAnimationFrame(() => this.frame());
  }
  /// Colours anew, as when the page turns dark.
  repaint(): void {
    this.palette = readPalette(this.probe, this.description.scene.materials);
    this.rim.copy(this.palette.ink);
    this.scene.background = this.palette.page;
    for (const robot of this.robots) robot.paint(this.palette, this.palette.warning);
    for (const layer of [this.forces, this.hooks, this.traces]) layer.paint(this.palette, this.stage);
    for (const layer of [this.penetration, this.decorations, this.overlay]) layer.paint(this.palette);
    this.ground?.paint(this.palette);
    this.changed();
  }
  private ratio(): number {
    const device = window.devicePixelRatio || 1;
    return this.wantedQuality === "low" ? 1 : this.wantedQuality === "medium" ? Math.min(device, 2) : device;
  }
  private resize(): void {
    this.width = this.host.clientWidth;
    this.height = this.host.clientHeight;
    const ratio = this.ratio();
    const [width, height] = [Math.max(1, Math.round(this.width * ratio)), Math.max(1, Math.round(this.height * ratio))];
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
    // At once: a canvas is empty after its size was set, and would flicker.
    this.frame();
  }
  private sizeLayers(width: number, height: number, scale: number): void {
    for (const robot of this.robots) robot.size(width, height, scale);
    for (const layer of [this.hooks.strokes, this.decorations.strokeLayer, this.spring.strokes]) layer.size(width, height, scale);
    for (const layer of [this.hooks.anchors, this.penetration.dots, this.traces.dots, this.spring.ends, ...this.decorations.dotLayers])
      layer.scale(scale);
  }
  private frame(): void {
    if (this.asked !== 0) cancelAnimationFrame(this.asked);
    this.asked = 0;
    if (!this.painter || this.painter.lost || this.width === 0 || this.height === 0) return;
    this.paintTo(this.painter, this.context, this.width, this.height, this.ratio());
    this.canvas.dataset.frames = String(++this.frames);
    this.canvas.dataset.gone = this.gone(this.width, this.height).map((each) => each.text).join(", ");
  }
  /// Paints a picture of width x height CSS pixels into a canvas that has `scale` pixels to each.
  private paintTo(painter: Painter, context: CanvasRenderingContext2D, width: number, height: number, scale: number): void {
    const [across, down] = [context.canvas.width, context.canvas.height];
    this.look(across / down);
    this.fill();
    this.sizeLayers(across, down, scale);
    painter.paint(this.scene, this.camera, context, across, down);
    this.writeLabels(width, height);
    this.overlay.draw(context, width, height, scale, this.values, this.legends(width, height), this.labels, this.gone(width, height));
  }
  private look(aspect: number): void {
    const { stage } = this;
    const followed = typeof this.follow === "number" ? this.description.scene.bodies[this.follow] : undefined;
    if (followed && stage.snapshot) stage.fromBody(0, this.follow as number, this.target.fromArray(followed.center_of_mass));
    else this.target.copy(stage.center);
    if (this.follow === "robots") this.target.add(this.companion.displacement);
    this.target.add(this.offset);
    const reach = Math.max(this.ground?.reach(this.values.distance) ?? 0, stage.radius, stage.farthest) + this.target.length();
    placeCamera(this.camera, this.values, this.target, aspect, reach);
    // From the viewer, a little from above left, as on a drawing.
    this.light.head.set(-0.4, 0.6, 1).normalize().applyQuaternion(this.camera.quaternion);
    const shadow = this.sun.shadow.camera;
    const size = 1.6 * stage.surround;
    this.sun.castShadow = this.shadows;
    this.sun.position.copy(this.target).addScaledVector(sunward, 4 * size);
    this.sun.target.position.copy(this.target);
    if (shadow.right !== size) {
      shadow.left = shadow.bottom = -size;
      shadow.right = shadow.top = size;
      shadow.near = size;
      shadow.far = 8 * size;
      shadow.updateProjectionMatrix();
    }
  }
  private get shadows(): boolean {
    return this.wantedQuality === "high";
  }
  private get forceLength(): number {
    return 0.8 * this.stage.radius;
  }
  private fill(): void {
    const { stage, shown } = this;
    this.ground?.show(shown.terrain, shown.edges, this.shadows);
    this.ground?.place(stage.snapshot ? stage.drawn[0] : null, this.target, this.values.distance, stage.surround);
    this.robots.forEach((robot, k) => {
      // A subject that failed may have no place any more.
      robot.group.visible = stage.snapshot !== null && stage.visible[k] && Number.isFinite(stage.drawn[k][0]);
      robot.show(shown.shapes, this.shadows, shown.terrain && !this.shadows ? (this.ground?.flat ?? null) : null);
      if (!robot.group.visible) return;
      robot.pose(stage.drawn[k]);
      if (this.shadows) robot.placeSolids(stage.drawn[k]);
    });
    this.forces.group.visible = shown.contact_forces;
    if (shown.contact_forces) this.forces.fill(stage, this.forceLength);
    if (shown.hooks) this.hooks.fill(stage, this.hookExaggeration);
    else this.hooks.strokes.mesh.visible = this.hooks.anchors.points.visible = false;
    if (shown.penetration) this.penetration.fill(stage);
    else this.penetration.dots.points.visible = false;
    if (shown.slip_traces) this.traces.fill(stage);
    else this.traces.dots.points.visible = false;
    this.decorations.fill(shown);
    this.spring.fill(stage, this.palette.warning);
  }
  private writeLabels(width: number, height: number): void {
    this.labels.length = 0;
    const write = (at: Vector3, text: string, strong: boolean) => {
      const { x, y, z } = at.project(this.camera);
      if (z < 1) this.labels.push({ x: ((x + 1) / 2) * width + 12, y: ((1 - y) / 2) * height, text, strong });
    };
    if (this.shown.sensors && this.stage.snapshot && this.stage.visible[0])
      for (const sensor of this.description.scene.sensors)
        write(this.stage.fromBody(0, sensor.body, place.fromArray(sensor.location)), sensor.trail, false);
    if (this.spring.held && this.stage.snapshot) {
      const force = this.pullForce ?? this.description.pull.stiffness * this.spring.stretch(this.stage);
      write(place.copy(this.spring.target), `${shortNumber(force)} N`, true);
    }
  }
  /// Of each robot or subject that has left the picture, where it is and how far from its start.
  private gone(width: number, height: number): Gone[] {
    const { stage, description } = this;
    const many = description.subjects.length > 1;
    if (!stage.snapshot || this.mobile < 0) return [];
    return description.subjects.flatMap((subject, k) => {
      if (!stage.visible[k] || !stage.snapshot!.subjects[k].fine) return [];
      stage.fromBody(k, this.mobile, place.fromArray(description.scene.bodies[this.mobile].center_of_mass));
      const behind = axisBack.copy(place).sub(this.camera.position).applyQuaternion(pictureTurn.copy(this.camera.quaternion).invert()).z > 0;
      place.project(this.camera);
      const at = edgePlace(place.x, place.y, behind, width, height, edgeMargin);
      if (at === null || !Number.isFinite(at.x + at.y)) return [];
      const name = many ? subject.name : description.scene.bodies[this.mobile].trail.split(".").at(-2) ?? "";
      return [{ ...at, colour: many ? subject.colour : css(this.palette.ink), text: `${name} ${lengthText(stage.displacement(k, this.mobile, place).length())}` }];
    });
  }
  private legends(width: number, height: number): Legends {
    const { subjects, scene } = this.description;
    const { stage, shown, ground } = this;
    const many = ground !== null && shown.terrain && ground.materials.length > 1;
    return {
      subjects: subjects.length > 1 ? subjects.filter((_, k) => stage.visible[k]) : [],
      materials: many ? ground.materials.map((index) => ({ name: scene.materials[index] ?? String(index), index })) : [],
      force: shown.contact_forces && stage.weight > 0
        ? { pixels: this.forceLength * pixelsPerMetre(this.values, width, height), newtons: stage.weight }
        : null,
      depth: shown.penetration ? this.penetration.scale : null,
      hooks: shown.hooks ? this.hookExaggeration : null,
      exaggeration: stage.exaggeration === 1 ? null : { factor: stage.exaggeration, alongGround: stage.alongGround },
    };
  }

  // ---- what the user does ----

  private aim(x: number, y: number): void {
    this.look(this.width / this.height);
    this.caster.setFromCamera(pixel.set((2 * x) / this.width - 1, 1 - (2 * y) / this.height), this.camera);
  }
  /// The body of the run itself at a place in the canvas [CSS pixels].
  pick(x: number, y: number): Pick | null {
    const robot = this.robots[0];
    if (!robot || !this.stage.snapshot || !this.stage.visible[0]) return null;
    this.aim(x, y);
    robot.placeSolids(this.stage.drawn[0]);
    robot.group.updateMatrixWorld();
    const hit = this.caster.intersectObjects(robot.solids, false)[0];
    if (!hit) return null;
    const body = hit.object.userData.body as number;
    const world = hit.point.toArray() as Numbers3;
    return { body, world, point: this.stage.toBody(0, body, hit.point.clone()).toArray() as Numbers3 };
  }
  private gestures() {
    return {
      values: () => this.values,
      change: (values: CameraValues) => {
        this.values = values;
        this.awaited = {};
        this.changedAt = performance.now();
        this.changed();
        this.onCameraChange({ ...values });
      },
      pan: (across: number, upwards: number) => {
        cameraAxes(this.values, axisRight, axisUp, axisBack);
        const metres = (2 * this.values.distance * halfHeight(this.values.zoom, this.width / this.height)) / this.height;
        this.offset.addScaledVector(axisRight, across * metres).addScaledVector(axisUp, upwards * metres);
        this.changed();
      },
      recentre: () => {
        this.offset.set(0, 0, 0);
        this.changed();
      },
      pullStart: (x: number, y: number) => {
        const found = this.pulls ? this.pick(x, y) : null;
        if (!found || this.description.scene.bodies[found.body].robot < 0) return false;
        this.spring.start(found.body, new Vector3(...found.point), new Vector3(...found.world));
        this.onPullStart(found.body, found.point, this.spring.realTarget(this.stage).toArray());
        this.changed();
        return true;
      },
      pullMove: (x: number, y: number) => {
        if (!this.spring.held) return;
        this.aim(x, y);
        cameraAxes(this.values, axisRight, axisUp, axisBack);
        if (!this.spring.move(this.stage, this.caster.ray, axisBack)) return;
        this.onPullMove(this.spring.realTarget(this.stage).toArray());
        this.changed();
      },
      pullEnd: () => {
        this.spring.release();
        this.pullForce = null;
        this.onPullEnd();
        this.changed();
      },
      select: (x: number, y: number) => {
        const found = this.pick(x, y);
        this.select(found?.body ?? null);
        this.onSelect(found?.body ?? null);
      },
    };
  }

  /// Draws at once, not with the next frame of the screen; the canvas has the picture then.
  drawNow(): HTMLCanvasElement {
    this.frame();
    return this.canvas;
  }
  /// The picture as it stands, or of another size, as PNG.
  picture(width = this.canvas.width, height = this.canvas.height): Promise<Blob> {
    if (!this.painter || this.painter.lost) return Promise.reject(new Error("this browser gives no WebGL to make a picture with"));
    const canvas = document.createElement("canvas");
    canvas.width = width;
    canvas.height = height;
    const context = canvas.getContext("2d", { alpha: false });
    if (!context) return Promise.reject(new Error("this browser draws no canvas"));
    const scale = Math.max(1, Math.min(width / Math.max(this.width, 1), height / Math.max(this.height, 1)));
    this.paintTo(this.painter, context, width / scale, height / scale, scale);
    return new Promise((resolve, reject) =>
      canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("the browser made no PNG of the picture"))), "image/png"),
    );
  }

  dispose(): void {
    if (this.asked !== 0) cancelAnimationFrame(this.asked);
    if (this.settling !== 0) window.clearTimeout(this.settling);
    this.observer.disconnect();
    this.scheme.removeEventListener("change", this.onScheme);
    this.pointer.dispose();
    this.painter?.leave(this.onPainter);
    this.painter = null;
    for (const each of [
      ...this.robots, this.forces, this.hooks, this.penetration, this.traces, this.decorations, this.spring,
    ])
      each.dispose();
    this.ground?.dispose();
    this.canvas.remove();
    this.notice.remove();
    this.probe.remove();
  }
}

const [place, axisRight, axisUp, axisBack] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()];
const pictureTurn = new Quaternion();
const pixel = new Vector2();
