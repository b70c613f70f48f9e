// Where points slid over the ground: the last few thousand places, per scene. Going back in time takes back what came later.
import { type Color, Vector3 } from "three";
import { Dots } from "./dots.ts";
import { mix, type Palette } from "./colours.ts";
import { numbersOfContact, type Stage } from "./stage.ts";

const capacity = 4096;
const numbers = 5; // time, subject, x, y, z

const point = new Vector3();

export class SlipTraces {
  readonly dots: Dots;
  private readonly places = new Float64Array(capacity * numbers);
  private first = 0;
  private count = 0;
  private colours: Color[] = [];

  constructor(rim: Color) {
    this.dots = new Dots("disc", rim, { order: 3 });
  }
  paint(palette: Palette, stage: Stage): void {
    this.colours = stage.description.subjects.map(({ colour }) => mix(colour, palette.ink, 0.15));
  }
  clear(): void {
    this.count = 0;
  }
  private at(index: number): number {
    return ((this.first + index) % capacity) * numbers;
  }
  /// Takes the places of a snapshot; needs the stage's poses to be those of the snapshot.
  take(stage: Stage): void {
    if (!stage.snapshot) return;
    const { time, subjects } = stage.snapshot;
    while (this.count > 0 && this.places[this.at(this.count - 1)] >= time) --this.count;
    for (let k = 0; k < subjects.length; ++k) {
      const { contacts } = subjects[k];
      for (let at = 0; at < contacts.length; at += numbersOfContact) {
        if (contacts[at + 11] !== 1) continue;
        if (this.count === capacity) {
          this.first = (this.first + 1) % capacity;
          --this.count;
        }
        stage.drawnPoint(k, contacts[at], contacts[at + 1], contacts[at + 2], contacts[at + 3], point);
        const place = this.at(this.count++);
        this.places[place] = time;
        this.places[place + 1] = k;
        point.toArray(this.places, place + 2);
      }
    }
  }
  fill(stage: Stage): void {
    this.dots.begin();
    for (let k = 0; k < this.count; ++k) {
      const at = this.at(k);
      const subject = this.places[at + 1];
      if (stage.visible[subject])
        this.dots.add(this.places[at + 2], this.places[at + 3], this.places[at + 4], this.colours[subject], 3);
    }
    this.dots.end();
  }
  dispose(): void {
    this.dots.dispose();
  }
}
