// What is written over a picture: axes, legends, labels. Plain text with a halo of the page's colour; part of saved pictures.
import { Vector3 } from "three";
import { type CameraValues, cameraAxes } from "./camera.ts";
import { axisColours, css, depthColour, mix, type Palette, tileColour } from "./colours.ts";
import type { EdgePlace } from "./fitting.ts";

export interface Label {
  x: number;
  y: number;
  text: string;
  strong: boolean;
}
export interface Legends {
  subjects: { name: string; colour: string }[]; // empty where there is only one
  materials: { name: string; index: number }[];
  force: { pixels: number; newtons: number } | null; // of one body weight
  depth: number | null; // deepest of the colour bar [m]
  hooks: number | null; // factor
  exaggeration: { factor: number; alongGround: boolean } | null;
}

/// Something that has left the picture: an arrow at its edge.
export interface Gone extends EdgePlace {
  colour: string;
  text: string;
}

const fontSize = 11;
const line = 16;
const margin = 10;

/// With thin spaces between thousands.
export function grouped(value: number): string {
  return String(value).replace(/\B(?=(\d{3})+(?!\d))/g, "\u202f");
}
export function shortNumber(value: number): string {
  const text = value !== 0 && (Math.abs(value) >= 1e5 || Math.abs(value) < 1e-3) ? value.toExponential(2) : value.toPrecision(3);
  return text.replace("-", "\u2212");
}
/// The part of an arrow of so many pixels, 1 or a power of ten, whose length is at most `most` and, so, seen.
export function scalePart(pixels: number, most: number): number {
  let part = 1;
  while (part * pixels > most) part /= 10;
  while (part * pixels < most / 20) part *= 10;
  return part;
}
/// A length with the unit that fits it.
export function lengthText(metres: number): string {
  const [factor, unit] = metres >= 1 ? [1, "m"] : metres >= 1e-3 ? [1e3, "mm"] : metres >= 1e-6 ? [1e6, "\u00b5m"] : [1e9, "nm"];
  return `${Number((metres * factor).toPrecision(3))} ${unit}`;
}

export class Overlay {
  private readonly right = new Vector3();
  private readonly up = new Vector3();
  private readonly back = new Vector3();
  private readonly order = [0, 1, 2];

  constructor(private palette: Palette) {}
  paint(palette: Palette): void {
    this.palette = palette;
  }
  private text(to: CanvasRenderingContext2D, text: string, x: number, y: number, colour: string): void {
    to.strokeStyle = css(this.palette.page);
    to.lineWidth = 3;
    to.lineJoin = "round";
    to.strokeText(text, x, y);
    to.fillStyle = colour;
    to.fillText(text, x, y);
  }

  draw(
    to: CanvasRenderingContext2D, width: number, height: number, scale: number, camera: CameraValues, legends: Legends, labels: Label[], gone: Gone[],
  ): void {
    to.save();
    to.scale(scale, scale);
    to.font = `${fontSize}px ${this.palette.typeFace}`;
    to.textBaseline = "middle";
    const ink = css(this.palette.ink);
    this.triad(to, height, camera);
    let y = margin + line / 2;
    const x = margin;
    const swatch = (colour: string) => {
      to.fillStyle = colour;
      to.fillRect(x, y - 5, 10, 10);
      to.strokeStyle = css(this.palette.quiet);
      to.lineWidth = 0.5;
      to.strokeRect(x, y - 5, 10, 10);
    };
    for (const subject of legends.subjects) {
      swatch(subject.colour);
      this.text(to, subject.name, x + 16, y, ink);
      y += line;
    }
    for (const material of legends.materials) {
      swatch(css(tileColour(material.index, this.palette)));
      this.text(to, material.name, x + 16, y, ink);
      y += line;
    }
    if (legends.exaggeration) {
      const { factor, alongGround } = legends.exaggeration;
      this.text(to, `displacement${alongGround ? " along the ground" : ""} \u00d7 ${grouped(factor)}`, x, y, ink);
      y += line;
    }
    if (legends.hooks !== null) {
      this.text(to, `stretch of hooks \u00d7 ${grouped(legends.hooks)}`, x, y, ink);
      y += line;
    }
    if (legends.force) {
      const part = scalePart(legends.force.pixels, 0.25 * width);
      const shown = part * legends.force.pixels;
      this.arrow(to, x, y, shown, ink);
      const name = part === 1 ? "1 body weight" : part > 1 ? `${part} body weights` : `1/${Math.round(1 / part)} body weight`;
      this.text(to, `${name} = ${shortNumber(part * legends.force.newtons)} N`, x + shown + 6, y, ink);
      y += line;
    }
    if (legends.depth !== null) this.depthBar(to, x, y, legends.depth, ink);
    for (const label of labels) {
      to.font = `${label.strong ? "600 " : ""}${fontSize}px ${this.palette.typeFace}`;
      this.text(to, label.text, label.x, label.y, ink);
    }
    for (const each of gone) this.pointer(to, each, width);
    to.restore();
  }

  private pointer(to: CanvasRenderingContext2D, { x, y, angle, colour, text }: Gone, width: number): void {
    to.save();
    to.translate(x, y);
    to.rotate(angle);
    to.beginPath();
    to.moveTo(10, 0);
    to.lineTo(-6, -7);
    to.lineTo(-6, 7);
    to.closePath();
    to.fillStyle = colour;
    to.strokeStyle = css(this.palette.ink);
    to.lineWidth = 1;
    to.fill();
    to.stroke();
    to.restore();
    // The text stands on the inner side.
    to.textAlign = x > width / 2 ? "right" : "left";
    this.text(to, text, x + (x > width / 2 ? -14 : 14), y, css(this.palette.ink));
    to.textAlign = "left";
  }
  private arrow(to: CanvasRenderingContext2D, x: number, y: number, length: number, colour: string): void {
    to.strokeStyle = to.fillStyle = colour;
    to.lineWidth = 1.5;
    to.beginPath();
    to.moveTo(x, y);
    to.lineTo(x + length - 6, y);
    to.stroke();
    to.beginPath();
    to.moveTo(x + length, y);
    to.lineTo(x + length - 7, y - 3);
    to.lineTo(x + length - 7, y + 3);
    to.fill();
  }
  private depthBar(to: CanvasRenderingContext2D, x: number, y: number, deepest: number, ink: string): void {
    const [long, steps] = [100, 50];
    for (let step = 0; step < steps; ++step) {
      to.fillStyle = css(depthColour((step + 0.5) / steps, this.palette));
      to.fillRect(x + (long * step) / steps, y - 5, long / steps + 0.5, 10);
    }
    to.strokeStyle = css(this.palette.quiet);
    to.lineWidth = 0.5;
    to.strokeRect(x, y - 5, long, 10);
    this.text(to, `0 to ${lengthText(deepest)} deep`, x + long + 6, y, ink);
  }
  private triad(to: CanvasRenderingContext2D, height: number, camera: CameraValues): void {
    cameraAxes(camera, this.right, this.up, this.back);
    const [x, y, long] = [margin + 30, height - margin - 30, 24];
    this.order.sort((one, other) => this.back.getComponent(one) - this.back.getComponent(other));
    for (const axis of this.order) {
      const across = this.right.getComponent(axis);
      const upwards = this.up.getComponent(axis);
      const colour = css(mix(axisColours[axis], this.palette.ink, this.palette.dark ? 0.25 : 0));
      to.strokeStyle = colour;
      to.lineWidth = 2;
      to.lineCap = "round";
      to.beginPath();
      to.moveTo(x, y);
      to.lineTo(x + long * across, y - long * upwards);
      to.stroke();
      to.textAlign = "center";
      this.text(to, "xyz"[axis], x + (long + 8) * across, y - (long + 8) * upwards, colour);
      to.textAlign = "left";
    }
  }
}
