// What a robot is judged by, for a file that has no windows of its own: height, speed and attitude of the first robot's base, what its
// feet carry, its energy, or the angles of an arm; sliders for what controllers aim at and for drives that nothing drives.
import type { Context, Part } from "./context.ts";
import { element, setText } from "./dom.ts";
import type { PlotTrace, PortDescription, ValuatorWidget } from "./protocol.ts";
import { firstMobileBase } from "./scene/companion.ts";
import { makePlot } from "./widgets/plot.ts";
import { makeSlider } from "./widgets/slider.ts";

const mostTraces = 8; // of a plot
const mostSliders = 12; // of a kind
const heightOfPlot = 110;
const degrees = 180 / Math.PI;

type Ports = Map<string, PortDescription>;

export interface OverviewPlot {
  label: string;
  traces: PlotTrace[];
}

/// Roll and pitch of a unit quaternion w x y z: turns about x and then y that follow one about z.
export function roll(w: number, x: number, y: number, z: number): number {
  return Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)) * degrees;
}
export function pitch(w: number, x: number, y: number, z: number): number {
  return Math.asin(Math.min(1, Math.max(-1, 2 * (w * y - z * x)))) * degrees;
}

/// The heading: the turn about z.
export function yaw(w: number, x: number, y: number, z: number): number {
  return Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)) * degrees;
}

export function plotsOf(context: Pick<Context, "description">, ports: Ports): OverviewPlot[] {
  const { bodies } = context.description.scene;
  const mobile = firstMobileBase(bodies);
  const base = mobile >= 0 ? mobile : bodies.findIndex((body) => body.robot >= 0);
  if (base < 0) return [];
  const robot = bodies[base].trail.replace(/\.[^.]*$/, "");
  const own = bodies.filter((body) => body.robot === bodies[base].robot);
  const trace = (trail: string, label: string): PlotTrace[] => {
    const port = ports.get(trail);
    return port === undefined ? [] : [{ x: null, y: trail, label, unit: port.unit, x_unit: "s" }];
  };
  const orientation = ["w", "x", "y", "z"].map((part) => `${robot}.orientation.${part}`);
  const turn = (label: string, from: (...numbers: number[]) => number): PlotTrace[] =>
    orientation.every((trail) => ports.has(trail)) ? [{ x: null, y: `${robot} ${label}`, label, unit: "deg", x_unit: "s", of: orientation, from }] : [];
  const name = (trail: string) => trail.slice(robot.length + 1);
  const joints = (port: string) => own.filter((body) => body.joint !== null).slice(0, mostTraces).flatMap((body) => trace(`${body.trail}.${port}`, name(body.trail)));
  const leaves = own.filter((body) => !bodies.some((each) => bodies[each.parent] === body));
  const plots: OverviewPlot[] = mobile >= 0
    ? [
        { label: "Height", traces: trace(`${robot}.position.z`, "height") },
        { label: "Speed", traces: ["x", "y", "z"].flatMap((axis) => trace(`${robot}.velocity.${axis}`, axis)) },
        { label: "Attitude", traces: [...turn("roll", roll), ...turn("pitch", pitch)] },
      ]
    : [{ label: "Joints", traces: joints("angle") }, { label: "Rates", traces: joints("rate") }];
  if (context.description.scene.terrain !== null)
    plots.push({ label: "Load", traces: leaves.slice(0, mostTraces).flatMap((body) => trace(`${body.trail}.contact.force.z`, name(body.trail))) });
  plots.push({ label: "Energy", traces: [...trace(`${robot}.kinetic_energy`, "kinetic"), ...trace(`${robot}.potential_energy`, "potential")] });
  return plots.filter((plot) => plot.traces.length > 0);
}

export interface SliderGroup {
  label: string;
  sliders: ValuatorWidget[];
}

/// Of what may be set and nothing drives.
export function slidersOf(context: Pick<Context, "description">, ports: Ports): SliderGroup[] {
  const { scene } = context.description;
  const weight = Math.hypot(...scene.gravity) * scene.bodies.reduce((sum, body) => sum + body.mass, 0);
  const slider = (port: PortDescription, range: number | null): ValuatorWidget => ({
    type: "Valuator.Slider", trail: port.trail, label: port.trail.replace(`${context.description.world}.`, ""), port: port.trail, unit: port.unit,
    range: range === null ? null : [-range, range], increment: null,
  });
  const settable = [...ports.values()].filter((port) => port.writable);
  const joints = new Set(scene.bodies.filter((body) => body.joint !== null).flatMap((body) => [`${body.trail}.torque`, `${body.trail}.force`]));
  return [
    { label: "Goals", sliders: settable.filter((port) => /\.goal(\[\d+\])?$/.test(port.trail)).slice(0, mostSliders).map((port) => slider(port, null)) },
    { label: "Drives", sliders: settable.filter((port) => joints.has(port.trail)).slice(0, mostSliders).map((port) => slider(port, Math.max(1, Number((weight / 2).toPrecision(1))))) },
  ].filter((group) => group.sliders.length > 0);
}

export function makeOverview(context: Context): Part {
  const pane = element("div", { class: "pane overview" }, element("p", { class: "quiet" }, "looking for the robot's values"));
  const parts: Part[] = [];
  let gone = false;
  context.connection.request("trails", { pattern: "**" }).then((answer) => {
    if (gone) return;
    const ports: Ports = new Map(answer.ports.map((port) => [port.trail, port]));
    for (const { label, traces } of plotsOf(context, ports))
      parts.push(makePlot(context, { type: "Plot", trail: `overview.${label}`, label, traces, height: heightOfPlot, range: null, x_range: null, window: null, overlay: null }));
    pane.replaceChildren(...parts.map((part) => part.element));
    if (context.description.kind === "movie") return;
    for (const { label, sliders } of slidersOf(context, ports)) {
      const made = sliders.map((each) => makeSlider(context, each));
      parts.push(...made);
      pane.append(element("section", { role: "group", "aria-label": label }, element("h3", {}, label), ...made.map((part) => part.element)));
    }
    if (parts.length === 0) pane.replaceChildren(element("p", { class: "quiet" }, "there is no robot"));
  }, (refused: Error) => setText(pane, refused.message));
  return {
    element: pane,
    dispose: () => {
      gone = true;
      parts.forEach((part) => part.dispose());
    },
  };
}
