// The protocol of the window, version 1, as docs/view_protocol.md has it: what the program tells,
// what the page asks. Everything is SI, world axes, z up, unless a unit is given.

import type { Switch } from "./scene/switches.ts";
import type { OpenRequest, StudiesDescription, StudyTold } from "./study/protocol.ts";

export const protocolVersion = 1;

export type Vector3 = [number, number, number];
export type Quaternion = [number, number, number, number]; // w x y z
export type Range = [number, number]; // least, greatest

// ---- the description ----

export interface Description {
  tell: "description";
  protocol: number;
  version: string;
  title: string;
  kind: "run" | "movie" | "film";
  world: string;
  deltat: number;
  duration: number | null;
  holds: boolean; // playing waits at the duration, until somebody has it go on
  engine: string;
  law: string;
  integrator: string;
  history: { possible: boolean; why: string };
  windows: Widget[];
  scene: SceneDescription;
  subjects: Subject[];
  pull: { stiffness: number; damping: number };
  film?: Film;
  recorded?: boolean; // the page itself has the movie
}

/// What a page that makes a film is to draw.
export interface Film {
  camera: string; // trail
  width: number;
  height: number;
  rate: number; // pictures a second
  frames: number;
  format: "png" | "webm" | "mp4" | "webp";
  quality: "low" | "medium" | "high";
  caption: string | null; // before the time in each picture; null: neither
}

export interface SceneDescription {
  bodies: Body[];
  terrain: Terrain | null;
  materials: string[];
  gravity: Vector3;
  sensors: Sensor[];
}

export interface Subject {
  name: string;
  colour: string;
}

/// A body of a robot, an obstacle, or ground that moves, which has no shape of its own.
export interface Body {
  trail: string;
  robot: number; // -1: no robot carries it
  parent: number; // index of a body, or -1
  mass: number;
  center_of_mass: Vector3;
  inertia: [number, number, number, number, number, number]; // Ixx Iyy Izz Ixy Ixz Iyz
  joint: "revolute" | "prismatic" | null; // about, or along, the body's own z through its origin
  limits?: [number | null, number | null]; // of the joint [rad or m]
  material: number | null; // of an obstacle
  shapes: Shape[];
  points: Vector3[];
  start?: number[]; // pose at time 0: x y z, qw qx qy qz
}

interface PlacedShape {
  location: Vector3;
  orientation: Quaternion;
}
export type Shape = PlacedShape &
  (
    | { kind: "box"; dimensions: Vector3 }
    | { kind: "sphere"; radius: number }
    | { kind: "cylinder"; radius: number; length: number }
    | { kind: "legcone"; length: number; proximal_radius: number; distal_radius: number }
    | { kind: "capsule"; radius: number; length: number } // of the cylindrical part, along z
    | { kind: "hull"; vertices: number[]; faces: number[][] } // x y z of each; counter-clockwise from outside
  );

export interface Terrain {
  vertices: number[]; // x y z of each
  tiles: number[][]; // material, then three to six vertices
  body: number; // whose axes they are in; -1: world axes
  endless: number | null; // material of a plane that goes on beyond the tiles
}

export interface Sensor {
  trail: string;
  type: string;
  body: number;
  location: Vector3;
}

// ---- widgets ----

interface WidgetFrame {
  trail: string;
  label: string;
  width?: number | null;
  height?: number | null;
}
export type WindowWidget = WidgetFrame & { type: "Window"; children: Widget[] };
export type CameraWidget = WidgetFrame & {
  type: "Window.grob";
  drawer: string;
  follow: string | null;
  accompany?: boolean; // goes with the robots: a camera that the page makes of its own
  ports: { zoom: string; distance: string; euler1: string; euler2: string; exaggeration?: string } & Partial<Record<Switch, string>>;
  show: Record<string, boolean>;
};
export type ValuatorWidget = WidgetFrame & {
  type: "Valuator.Slider" | "Valuator.Dial" | "Valuator.Counter" | "Valuator.Input";
  port: string;
  range: Range | null;
  unit: string;
  increment: number | null;
};
export type ButtonWidget = WidgetFrame & { type: "Button" | "Button.Light"; port: string };
export type ChoiceWidget = WidgetFrame & { type: "Button.Choice"; port: string; choices: string[] };
export type TextWidget = WidgetFrame & {
  type: "Text";
  text: string;
  values: { trail: string; unit: string; digits: number | null }[];
};
export type TableWidget = WidgetFrame & {
  type: "Table";
  rows: { trail: string; unit: string; label: string }[];
};
export interface PlotTrace {
  x: string | null;
  y: string;
  label: string;
  unit: string;
  x_unit: string;
  /// Of the page's own plots: trails of whose values `y`, a name, is worked out.
  of?: string[];
  from?: (...values: number[]) => number;
}
export type PlotWidget = WidgetFrame & {
  type: "Plot";
  traces: PlotTrace[];
  range: Range | null;
  x_range: Range | null;
  window: number | null;
  overlay: string | null;
};
export type Plot3DWidget = WidgetFrame & {
  type: "Plot.3D";
  traces?: { x: string; y: string; z: string; label: string; unit: string }[] | null;
  surface?: { x: string; y: string; z: string } | null;
};
export type Widget =
  | WindowWidget
  | CameraWidget
  | ValuatorWidget
  | ButtonWidget
  | ChoiceWidget
  | TextWidget
  | TableWidget
  | PlotWidget
  | Plot3DWidget;

// ---- what else the program tells ----

export interface Layout {
  tell: "layout";
  layout: number;
  values: string[];
  units: string[];
}
export interface Notice {
  tell: "notice";
  level: "note" | "warning" | "error";
  text: string;
}
export interface Changed {
  tell: "changed";
  step: number;
  time: number;
  trail: string;
  value: string;
}
export interface Ended {
  tell: "ended";
  reason: string;
}
/// How far long work has come, from 0 to 1.
export interface Working {
  tell: "working";
  of: string;
  done: number;
}
export type Told = Description | StudiesDescription | StudyTold | Layout | Notice | Changed | Ended | Working;

// ---- binary messages ----

export const kindOfSnapshot = 1;
export const kindOfTrace = 2;
export const numbersOfPose = 7;
export const numbersOfContact = 12;

export interface SubjectState {
  fine: boolean;
  poses: Float64Array; // 7 a body: x y z qw qx qy qz
  contacts: Float64Array; // 12 a contact: body, point 3, force 3, hook 3, depth, sliding
}

export interface Snapshot {
  layout: number;
  frame: number;
  step: number;
  time: number;
  paused: boolean;
  past: boolean; // shown from the history
  ended: boolean;
  failed: boolean;
  speedAsked: number; // 0: as fast as possible
  speedReached: number;
  historyFirst: number;
  historyLast: number;
  values: Float64Array; // in the layout's order, NaN for what is not known
  subjects: SubjectState[];
}

export interface Trace {
  id: number;
  times: Float64Array;
  values: Float64Array[]; // of each trail
}

// ---- what a page asks ----

export interface PortDescription {
  trail: string;
  unit: string;
  writable: boolean;
  minimum: number | null;
  maximum: number | null;
  doc: string;
}
export interface FieldDescription {
  trail: string;
  value: string;
  unit: string;
  doc: string;
}
export interface Reading {
  trail: string;
  value: number | null;
  unit: string;
}
export interface Change {
  step: number;
  time: number;
  trail: string;
  value: string;
}

/// Of a slider's port, where controllers that it moves make the step unstable.
export interface UnstableStretch {
  port: string;
  from: number;
  to: number;
}

/// What each request takes and what its answer holds. `trace` answers with a binary message.
export interface Requests {
  set: { with: { values: Record<string, number> }; answer: object };
  read: { with: { trails: string[] }; answer: { values: Reading[] } };
  trails: { with: { pattern: string }; answer: { ports: PortDescription[] } };
  watch: { with: { trails: string[] }; answer: object };
  trace: { with: { trails: string[]; from: number; to: number; points: number }; answer: Trace };
  pause: { with: object; answer: object };
  run: { with: object; answer: object };
  step: { with: { count: number }; answer: object };
  speed: { with: { factor: number }; answer: object };
  seek: { with: { time: number }; answer: object };
  reset: { with: object; answer: object };
  start_from: { with: { values: Record<string, number | number[]> }; answer: object };
  edit: { with: { trail: string; value: string }; answer: object };
  fields: { with: object; answer: { fields: FieldDescription[] } };
  changes: { with: object; answer: { changes: Change[] } };
  patch: { with: object; answer: { name: string; text: string } };
  unstable: { with: object; answer: { unstable: UnstableStretch[] } };
  picture: { with: { name: string; png: string }; answer: { path: string } };
  open: OpenRequest;
  quit: { with: object; answer: object };
  film_frame: { with: { index: number }; answer: { snapshot: number; time: number } };
  film_part: { with: { file: number; at: number; bytes: string }; answer: object };
  film_end: { with: { file: number }; answer: object };
  film_failed: { with: { text: string }; answer: object };
}
export type RequestName = keyof Requests;

/// A binary message that is not as the protocol has it.
export class ProtocolError extends Error {
  override readonly name = "ProtocolError";
}

/// Reads doubles one after the other and tells when they run out.
class Reader {
  private at = 0;
  private readonly doubles: Float64Array;
  constructor(buffer: ArrayBuffer) {
    if (buffer.byteLength % 8 !== 0)
      throw new ProtocolError(`a binary message of ${buffer.byteLength} bytes, which is no whole number of doubles`);
    this.doubles = new Float64Array(buffer);
  }
  next(): number {
    if (this.at >= this.doubles.length) throw new ProtocolError("a binary message that ends early");
    return this.doubles[this.at++];
  }
  count(what: string): number {
    const count = this.next();
    if (!Number.isInteger(count) || count < 0) throw new ProtocolError(`${count} as the count of ${what}`);
    return count;
  }
  many(count: number): Float64Array {
    if (this.at + count > this.doubles.length) throw new ProtocolError("a binary message that ends early");
    this.at += count;
    return this.doubles.subarray(this.at - count, this.at);
  }
  end(): void {
    if (this.at !== this.doubles.length)
      throw new ProtocolError(`${this.doubles.length - this.at} doubles after the end of a binary message`);
  }
}

/// A snapshot or a trace. The program sends little-endian doubles, as all machines that browsers
/// run on have them. The count of bodies is the description's.
export function parseBinary(buffer: ArrayBuffer, bodies: number): { snapshot: Snapshot } | { trace: Trace } {
  const reader = new Reader(buffer);
  const kind = reader.next();
  if (kind === kindOfSnapshot) return { snapshot: parseSnapshot(reader, bodies) };
  if (kind === kindOfTrace) return { trace: parseTrace(reader) };
  throw new ProtocolError(`a binary message of kind ${kind}`);
}

function parseSnapshot(reader: Reader, bodies: number): Snapshot {
  const [layout, frame, step, time, flags, speedAsked, speedReached, historyFirst, historyLast] = reader.many(9);
  const values = reader.many(reader.count("values"));
  const subjects: SubjectState[] = [];
  for (let left = reader.count("subjects"); left > 0; --left) {
    const fine = reader.next() === 1;
    const poses = reader.many(bodies * numbersOfPose);
    const contacts = reader.many(reader.count("contacts") * numbersOfContact);
    subjects.push({ fine, poses, contacts });
  }
  reader.end();
  return {
    layout, frame, step, time,
    paused: (flags & 1) !== 0,
    past: (flags & 2) !== 0,
    ended: (flags & 4) !== 0,
    failed: (flags & 8) !== 0,
    speedAsked, speedReached, historyFirst, historyLast, values, subjects,
  };
}

function parseTrace(reader: Reader): Trace {
  const id = reader.next();
  const trails = reader.count("trails");
  const instants = reader.count("instants");
  const times = reader.many(instants);
  const values: Float64Array[] = [];
  for (let trail = 0; trail < trails; ++trail) values.push(reader.many(instants));
  reader.end();
  return { id, times, values };
}
