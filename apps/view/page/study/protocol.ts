// What the program tells of studies and what their page asks (docs/view_protocol.md, "Studies").

export interface StudiesDescription {
  tell: "description";
  protocol: number;
  version: string;
  title: string;
  kind: "study";
  studies: Study[];
}

export interface Study extends State {
  name: string;
  title: string;
  question: string;
  progress: Progress;
  subjects: StudySubject[];
  columns: Column[]; // varied ones first
  rows: Row[];
  figures: Figure[];
}

export interface StudySubject {
  name: string;
  colour: string;
  marker: number; // as of a series
  composition: string;
}

export interface Column {
  name: string;
  unit: string;
  varied: boolean;
  names: string[]; // of the values 0, 1, ..., where these stand for something
}

export type Cell = [measured: number | null, predicted: number | null, ok: boolean | null];

export interface Row {
  subject: number;
  varied: number[];
  outcome: "" | "finished" | "foretold" | "stopped" | "skipped" | "refused"; // "": still to come
  status: string;
  cells: Cell[];
}

export interface Progress {
  done: number;
  total: number;
  seconds_left: number;
}

export interface State {
  state: "waiting" | "running" | "done" | "interrupted";
  report: string;
}

export interface Axis {
  label: string;
  unit: string;
  logarithmic: boolean;
  floor: number;
}

export interface Curve {
  x: number[];
  y: number[];
}

export interface FigureSeries {
  label: string;
  colour: string;
  marker: number; // circle, square, triangle, diamond, pentagon
  dashes: number[]; // of the line: strokes and gaps in turns; none: solid
  reference: boolean;
  measured: Curve;
  predicted: Curve;
  unfinished: number[];
}

interface FigureFrame {
  name: string;
  title: string;
  subtitle: string;
  caption: string;
  x: Axis;
  y: Axis;
}
export type CurvesFigure = FigureFrame & {
  kind: "curves";
  across: number;
  own_axes: boolean;
  panels: { title: string; series: FigureSeries[] }[];
};
export type MapFigure = FigureFrame & {
  kind: "map";
  colour: Axis;
  x_values: number[];
  y_values: number[];
  panels: { title: string; values: (number | null)[]; predicted: (number | null)[] }[]; // row after row from the bottom
};
export type Figure = CurvesFigure | MapFigure;

export type StudyTold =
  | ({ tell: "row"; study: number; row: number } & Row)
  | ({ tell: "figure"; study: number; figure: number } & Figure)
  | ({ tell: "progress"; study: number } & Progress)
  | ({ tell: "state"; study: number } & State);

/// The row's run in a window of its own.
export interface OpenRequest {
  with: { study: number; row: number };
  answer: { url: string };
}
