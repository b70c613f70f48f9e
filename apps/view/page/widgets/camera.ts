// Window.grob: a camera's picture of the world. Its place is in four ports, so that sliders, wires
// and the mouse move it alike; what it shows is chosen in a menu.
import { attempt, type Context, type Part } from "../context.ts";
import { download, element, freshId } from "../dom.ts";
import { icon, iconButton } from "../icons.ts";
import { makeMaximisable } from "../maximise.ts";
import type { CameraWidget } from "../protocol.ts";
import { CameraView, type Followed } from "../scene/view.ts";
import { switches, type Switch } from "../scene/switches.ts";

const placeNames = ["zoom", "distance", "euler1", "euler2"] as const;
const timeOfReset = 2000; // [ms] until its beginning has been seen
const settlingTime = 400; // [ms] in which older values of a port that was just set come in
const defaultWidth = 480;
const defaultHeight = 360;

const switchNames: Record<Switch, string> = {
  shapes: "shapes",
  terrain: "terrain",
  edges: "edges of the terrain",
  contact_forces: "contact forces",
  hooks: "hooks and their stretch",
  slip_traces: "slip traces",
  penetration: "penetration",
  frames: "frames",
  centers_of_mass: "centres of mass",
  inertia: "boxes of inertia",
  joint_axes: "joint axes",
  sensors: "sensors",
  boundary_points: "boundary points",
};

/// What a camera keeps when the page is made anew, as after the file was saved.
interface Kept {
  place: Record<(typeof placeNames)[number], number>;
  show: Partial<Record<Switch, boolean>>;
  follow: Followed;
}

/// `fill`: as large as what it stands in, for a page that is only a camera.
export function makeCamera(context: Context, widget: CameraWidget, fill = false): Part & { view: CameraView } {
  const { description } = context;
  const bodies = description.scene.bodies;
  const host = element("div", { class: "camera-host" });
  const kept = context.kept.get(widget.trail) as Kept | undefined;
  const ownFollow = widget.follow === null ? -1 : bodies.findIndex((body) => body.trail === widget.follow);
  const own: Followed = ownFollow >= 0 ? ownFollow : widget.accompany ? "robots" : null;
  const follow = kept === undefined || (typeof kept.follow === "number" && kept.follow >= bodies.length) ? own : kept.follow;
  const view = new CameraView(host, description, {
    label: widget.label || widget.trail,
    follow,
    show: kept?.show ?? (widget.show as Partial<Record<Switch, boolean>>),
    quality: context.quality,
    ...(kept === undefined ? {} : { camera: kept.place }),
  });
  view.canvas.dataset.trail = widget.trail;
  view.exaggeration = context.exaggeration;
  context.visible.forEach((visible, index) => view.setSubjectVisible(index, visible));
  view.select(context.selected);
  let followed = follow;
  const keep = () => context.kept.set(widget.trail, { place: view.cameraValues, show: { ...view.show }, follow: followed } satisfies Kept);

  // Its ports, where it has any: one that the page shows of its own has none.
  const ports = widget.ports;
  const wired = placeNames.every((name) => ports[name]);
  // A movie's ports stay as they were: once somebody has moved the camera, its place is the page's.
  const movie = description.kind === "movie";
  let moved = movie && kept !== undefined;
  const send = () => {
    if (movie) moved = true;
    if (!wired || movie) return;
    const place = view.cameraValues;
    for (const name of placeNames) attempt(context, context.setter.set(ports[name], place[name]));
  };
  view.onCameraChange = () => {
    keep();
    send();
  };
  if (kept !== undefined) send();
  // The run's beginning is asked for with a reset, not the camera's: what it moves back is set again.
  const restored = new Map<string, number>();
  const restore = (name: string, port: string, value: number): boolean => {
    const wanted = restored.get(name);
    if (wanted === undefined || value === wanted) return false;
    restored.delete(name);
    // A port that a wire drives refuses; then the wire has it.
    context.setter.set(port, wanted).catch(() => {});
    return true;
  };
  const forget = wired
    ? placeNames.map((name) => context.values.watch(ports[name], (value) => {
        if (restore(name, ports[name], value)) view.hold();
        if (!moved && value !== view.cameraValues[name]) {
          view.setCamera({ [name]: value });
          keep();
        }
      }))
    : [];
  // A port where the file has it, one number for all of the page: whoever changed it last counts.
  const exaggeration = ports.exaggeration;
  let told = NaN, setAt = -Infinity;
  if (exaggeration) {
    forget.push(context.values.watch(exaggeration, (value) => {
      told = value;
      if (restore("exaggeration", exaggeration, value)) setAt = performance.now();
      const settled = performance.now() - setAt > settlingTime;
      if (settled && value >= 1 && value !== context.exaggeration) context.setExaggeration(value);
    }));
  }
  if (!movie) {
    forget.push(context.resets.add(() => {
      for (const name of wired ? placeNames : []) restored.set(name, view.cameraValues[name]);
      if (exaggeration) restored.set("exaggeration", context.exaggeration);
      setTimeout(() => restored.clear(), timeOfReset);
    }));
  }
  // So is each switch that the file has. The boxes of the menu stand as their switches do.
  const boxes = new Map<Switch, HTMLInputElement>();
  const toldOf = new Map<Switch, boolean>();
  const show = (name: Switch, shown: boolean) => {
    view.show[name] = shown;
    const box = boxes.get(name);
    if (box) box.checked = shown;
    keep();
  };
  for (const name of switches) {
    const port = ports[name];
    if (!port) continue;
    forget.push(context.values.watch(port, (value) => {
      const shown = value !== 0;
      const first = !toldOf.has(name);
      if (Number.isNaN(value) || toldOf.get(name) === shown) return;
      toldOf.set(name, shown);
      if (shown === view.show[name]) return;
      // What was chosen before the page was made anew is chosen again, unless a wire drives the port.
      if (first && kept !== undefined && !movie) context.setter.set(port, Number(view.show[name])).catch(() => show(name, shown));
      else show(name, shown);
    }));
  }
  const choose = (name: Switch, shown: boolean) => {
    show(name, shown);
    const port = ports[name];
    if (port && !movie) context.setter.set(port, Number(shown)).catch((refused: Error) => {
      show(name, toldOf.get(name) ?? !shown);
      context.notice("warning", refused.message);
    });
  };
  let fitted = wired || kept !== undefined;
  forget.push(context.onSnapshot((snapshot) => {
    view.draw(snapshot);
    if (fitted) return;
    fitted = true;
    view.setCamera({ distance: view.fittingDistance });
  }));
  if (context.latest !== null) view.draw(context.latest);
  forget.push(
    context.onTheme(() => view.repaint()),
    context.onQuality((quality) => (view.quality = quality)),
    context.onExaggeration((factor) => {
      view.exaggeration = factor;
      if (!exaggeration || movie || factor === told) return;
      setAt = performance.now();
      attempt(context, context.setter.set(exaggeration, factor));
    }),
    context.onVisible((subject, visible) => view.setSubjectVisible(subject, visible)),
    context.onSelected((body) => view.select(body)),
  );
  view.onSelect = (body) => context.select(body);
  view.pulls = !movie;
  if (!movie) forget.push(wirePull(context, view));
  const picture = () => view.picture();
  const fit = () => view.fittingExaggeration;
  context.pictures.set(widget.trail, picture);
  context.fits.set(widget.trail, fit);

  const dispose = () => {
    forget.forEach((each) => each());
    if (context.pictures.get(widget.trail) === picture) context.pictures.delete(widget.trail);
    if (context.fits.get(widget.trail) === fit) context.fits.delete(widget.trail);
    view.dispose();
  };
  if (fill) return { element: host, dispose, view };

  const followChoice = element("select", { "aria-label": "follow a body" }, element("option", { value: "robots", selected: follow === "robots" }, "goes with the robots"), element("option", { value: "", selected: follow === null }, "follows no body"),
    ...bodies.map((body, index) => element("option", { value: index, selected: index === follow }, `follows ${body.trail}`)));
  followChoice.addEventListener("change", () => {
    const { value } = followChoice;
    followed = value === "" ? null : value === "robots" ? value : Number(value);
    view.setFollow(followed);
    keep();
  });
  const menu = element("details", { class: "menu" }, element("summary", { title: "what the camera shows", "aria-label": "what the camera shows" }, icon("more")),
    element("div", { class: "menu-body" }, ...switches.map((name) => {
      const id = freshId();
      const box = element("input", { type: "checkbox", id });
      box.checked = view.show[name];
      boxes.set(name, box);
      box.addEventListener("change", () => choose(name, box.checked));
      return element("div", {}, box, element("label", { for: id }, switchNames[name]));
    }), followChoice));
  const take = iconButton("picture", "save this picture", () => attempt(context, (async () => {
    download(`${widget.trail.replace(/[^\w.-]+/g, "_")}.png`, await view.picture());
  })()));
  const frame = element("figure", { class: "camera" },
    element("figcaption", {}, element("span", { class: "name" }, widget.label), take, menu), host);
  const [width, height] = [widget.width ?? defaultWidth, widget.height ?? defaultHeight];
  frame.style.setProperty("--width", `${width}px`);
  host.style.setProperty("--ratio", `${width} / ${height}`);
  makeMaximisable(frame, frame.querySelector("figcaption")!);
  return { element: frame, dispose, view };
}

/// A drag with control is a spring between a point of a body and the pointer.
function wirePull(context: Context, view: CameraView): () => void {
  const pull = "Simulator.pull";
  const set = (values: Record<string, number>) => {
    for (const [name, value] of Object.entries(values)) attempt(context, context.setter.set(`${pull}.${name}`, value));
  };
  const target = ([x, y, z]: number[]) => ({ "target.x": x, "target.y": y, "target.z": z });
  let unwatch: (() => void)[] = [];
  const force = [NaN, NaN, NaN];
  view.onPullStart = (body, [x, y, z], to) => {
    set({ stiffness: context.description.pull.stiffness, damping: context.description.pull.damping,
      "point.x": x, "point.y": y, "point.z": z, ...target(to), body });
    unwatch = ["x", "y", "z"].map((axis, i) => context.values.watch(`${pull}.force.${axis}`, (value) => {
      force[i] = value;
      const size = Math.hypot(...force);
      view.pullForce = Number.isNaN(size) ? null : size;
    }));
  };
  view.onPullMove = (to) => set(target(to));
  const end = () => {
    unwatch.forEach((each) => each());
    unwatch = [];
  };
  view.onPullEnd = () => {
    set({ body: -1 });
    end();
  };
  return end;
}
