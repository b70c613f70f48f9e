// Where points slid over the ground: the last few thousand places of a scene. Going back in time takes back what came later.
import { type Color, Vector3 } from "three";
import { mix, type Palette } from "./colours.ts";
import { Dots } from "./dots.ts";
import { numbersOfContact, type Stage } from "./stage.ts";

const capacity = 8192;
const numbers = 5; // time, subject, x, y, z
const mostOfBody = 64; // contacts of a body that are told apart

const point = new Vector3();

/// Places in the order of time; the oldest make way for the newest.
export class SlipPlaces {
  count = 0;
  private readonly places = new Float64Array(capacity * numbers);
  private first = 0;
  private readonly latest = new Map<number, Vector3>(); // of each contact that slid

  clear(): void {
    this.count = 0;
    this.latest.clear();
  }
  /// Where the place's numbers begin in `places`.
  private at(index: number): number {
    return ((this.first + index) % capacity) * numbers;
  }
  subject(index: number): number {
    return this.places[this.at(index) + 1];
  }
  place(index: number, out: Vector3): Vector3 {
    return out.fromArray(this.places, this.at(index) + 2);
  }
  /// Takes what slides in the stage's snapshot; places nearer than `spacing` to the one before are left out.
  take(stage: Stage, spacing: number): void {
    if (!stage.snapshot) return;
    const { time, subjects } = stage.snapshot;
    if (this.count > 0 && this.places[this.at(this.count - 1)] > time) {
      this.latest.clear();
      while (this.count > 0 && this.places[this.at(this.count - 1)] > time) --this.count;
    }
    for (let k = 0; k < subjects.length; ++k) this.takeSubject(stage, k, time, spacing);
  }
  private takeSubject(stage: Stage, subject: number, time: number, spacing: number): void {
    const { contacts } = stage.snapshot!.subjects[subject];
    let ofBody = 0;
    for (let at = 0; at < contacts.length; at += numbersOfContact) {
      const body = contacts[at];
      ofBody = at > 0 && contacts[at - numbersOfContact] === body ? ofBody + 1 : 0;
      if (contacts[at + 11] !== 1) continue;
      stage.drawnPoint(subject, body, contacts[at + 1], contacts[at + 2], contacts[at + 3], point);
      const key = (subject * stage.description.scene.bodies.length + body) * mostOfBody + (ofBody % mostOfBody);
      const before = this.latest.get(key);
      if (before && before.distanceTo(point) < spacing) continue;
      if (before) before.copy(point);
      else this.latest.set(key, point.clone());
      this.add(time, subject);
    }
  }
  private add(time: number, subject: number): void {
    if (this.count === capacity) {
      this.first = (this.first + 1) % capacity;
      --this.count;
    }
    const at = this.at(this.count++);
    this.places[at] = time;
    this.places[at + 1] = subject;
    point.toArray(this.places, at + 2);
  }
}

export class SlipTraces {
  readonly dots: Dots;
  private readonly places = new SlipPlaces();
  private colours: Color[] = [];

  constructor(rim: Color) {
    this.dots = new Dots("disc", rim, { order: 3 });
  }
  paint(palette: Palette, stage: Stage): void {
    this.colours = stage.description.subjects.map(({ colour }) => mix(colour, palette.ink, 0.15));
  }
  clear(): void {
    this.places.clear();
  }
  take(stage: Stage): void {
    this.places.take(stage, stage.radius / 200);
  }
  fill(stage: Stage): void {
    this.dots.begin();
    for (let k = 0; k < this.places.count; ++k) {
      const subject = this.places.subject(k);
      if (!stage.visible[subject]) continue;
      this.places.place(k, point);
      this.dots.add(point.x, point.y, point.z, this.colours[subject], 3);
    }
    this.dots.end();
  }
  dispose(): void {
    this.dots.dispose();
  }
}
