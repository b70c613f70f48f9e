// The pose of the robots as sliders: joints, and where bases stand. What is set starts the run again from the pose that is shown,
// at rest, and pauses it there.
import type { Connection } from "./connection.ts";
import type { Context, Part } from "./context.ts";
import { element } from "./dom.ts";
import { pitch, roll, yaw } from "./overview.ts";
import type { Body, Range } from "./protocol.ts";
import { makeSlider } from "./widgets/slider.ts";
import type { ValueLine } from "./widgets/valuator.ts";

const degrees = 180 / Math.PI;
const wayOfBase = 1; // to either side of where it stands [m]
const wayOfSlide = 0.5; // of a joint without limits [m]

type Values = Record<string, number | number[]>;

/// One request at a time, the newest values of each port next.
export class Starter {
  private wanted: Values = {};
  private under: Promise<void> | null = null;

  constructor(private readonly connection: Pick<Connection, "request">) {}

  set(trail: string, value: number | number[]): Promise<void> {
    this.wanted[trail] = value;
    this.under ??= this.run();
    return this.under;
  }

  private async run(): Promise<void> {
    try {
      // What one event sets goes together.
      await Promise.resolve();
      while (Object.keys(this.wanted).length > 0) {
        const values = this.wanted;
        this.wanted = {};
        await this.connection.request("start_from", { values });
      }
    } finally {
      this.wanted = {};
      this.under = null;
    }
  }
}

interface StateSlider {
  label: string;
  unit: string;
  range: Range;
  line: ValueLine;
}

/// Sliders of a robot's base, if it moves, and of its joints.
export function stateSliders(context: Pick<Context, "values">, starter: Starter, bodies: Body[], robot: number): StateSlider[] {
  const own = bodies.filter((body) => body.robot === robot);
  const base = own.find((body) => body.parent < 0 && body.mass > 0);
  const sliders = base === undefined ? [] : slidersOfBase(context, starter, base);
  const name = own.find((body) => body.parent < 0)?.trail.replace(/[^.]*$/, "") ?? "";
  for (const body of own) {
    if (body.joint === null) continue;
    const turns = body.joint === "revolute", scale = turns ? degrees : 1, port = `${body.trail}.angle`;
    const [least, greatest] = body.limits ?? [null, null], open = turns ? Math.PI : wayOfSlide;
    sliders.push({
      label: body.trail.slice(name.length), unit: turns ? "deg" : "m",
      range: [(least ?? Math.min(-open, (greatest ?? 0) - open)) * scale, (greatest ?? Math.max(open, (least ?? 0) + open)) * scale],
      line: { watch: (listener) => context.values.watch(port, (value) => listener(value * scale)), set: (value) => starter.set(port, value / scale) },
    });
  }
  return sliders;
}

function slidersOfBase({ values }: Pick<Context, "values">, starter: Starter, base: Body): StateSlider[] {
  const at = base.start ?? [0, 0, 0];
  const places = ["x", "y", "z"].map((axis, index): StateSlider => {
    const port = `${base.trail}.location.${axis}`;
    return {
      label: axis, unit: "m", range: [at[index] - wayOfBase, at[index] + wayOfBase],
      line: { watch: (listener) => values.watch(port, listener), set: (value) => starter.set(port, value) },
    };
  });
  const orientation = ["w", "x", "y", "z"].map((part) => `${base.trail}.orientation.${part}`);
  const now = (): number[] => orientation.map((trail) => values.read(trail)?.value ?? NaN);
  const angles = [roll, pitch, yaw];
  return [...places, ...["roll", "pitch", "yaw"].map((label, index): StateSlider => ({
    label, unit: "deg", range: index === 1 ? [-90, 90] : [-180, 180],
    line: {
      watch: (listener) => {
        const forget = orientation.map((trail) => values.watch(trail, () => {
          const [w, x, y, z] = now();
          listener(angles[index](w, x, y, z));
        }));
        return () => forget.forEach((each) => each());
      },
      set: (value) => {
        const [w, x, y, z] = now();
        return starter.set(`${base.trail}.orientation`, angles.map((angle, other) => (other === index ? value : angle(w, x, y, z)) / degrees));
      },
    },
  }))];
}

export function makeStateEditor(context: Context): Part {
  const { bodies } = context.description.scene;
  const starter = new Starter(context.connection);
  const parts: Part[] = [];
  const pane = element("div", { class: "pane overview" });
  if (context.description.kind === "movie") pane.append(element("p", { class: "quiet" }, "a movie is as it was recorded"));
  else {
    pane.append(element("p", { class: "quiet" }, "A value that is set starts the run again from this pose, at rest, and pauses it."));
    const robots = [...new Set(bodies.map((body) => body.robot))].filter((robot) => robot >= 0);
    for (const robot of robots) {
      const label = bodies.find((body) => body.robot === robot)!.trail.split(".").slice(1, -1).join(".");
      const made = stateSliders(context, starter, bodies, robot).map(({ line, ...slider }) =>
        makeSlider(context, { type: "Valuator.Slider", trail: `state ${label} ${slider.label}`, port: "", increment: null, ...slider }, line));
      if (made.length === 0) continue;
      parts.push(...made);
      pane.append(element("section", { role: "group", "aria-label": label }, element("h3", {}, label), ...made.map((part) => part.element)));
    }
    if (parts.length === 0) pane.append(element("p", { class: "quiet" }, "no robot can be moved"));
  }
  return { element: pane, dispose: () => parts.forEach((part) => part.dispose()) };
}
