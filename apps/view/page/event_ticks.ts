// The strip under the bar's time line: a tick for each event, the stretch that the plots show, the time under the pointer.
import type { Context, Part } from "./context.ts";
import { element, styleValue } from "./dom.ts";
import type { Range } from "./protocol.ts";
import { RunEvents, summaryOf, ticksOf, type EventKind } from "./run_events.ts";

const colours: Record<EventKind, string> = { touch: "--quiet", change: "--accent", end: "--ink", failure: "--warning" };
const thumb = 8; // half the width of the time line's thumb, whose middle marks the time [pixels]
const reach = 6; // of the pointer to an event [pixels]

export interface EventTicks extends Part {
  /// Draws for a time line from `range[0]` to `range[1]`.
  draw(range: Range): void;
}

/// `line` is the time line that the strip stands under.
export function makeEventTicks(context: Context, line: HTMLInputElement): EventTicks {
  const { description, connection } = context;
  const events = new RunEvents((body) => description.scene.bodies[body]?.trail ?? "a body");
  const canvas = element("canvas", { class: "event-ticks", role: "img" });
  const frame = element("span", { class: "time-line" }, line, canvas);
  let range: Range = [0, 1];
  let drawn = "";

  const change = (time: number, trail: string, value: string | number) => events.add({ time, kind: "change", text: `${trail} = ${value}` });
  connection.request("changes", {}).then(({ changes }) => changes.forEach((each) => change(each.time, each.trail, each.value)), () => {});

  const placeOf = (time: number, width: number) => thumb + ((time - range[0]) / (range[1] - range[0])) * (width - 2 * thumb);

  function draw(now: Range): void {
    range = now;
    const width = canvas.clientWidth, height = canvas.clientHeight;
    if (width === 0 || !(range[1] > range[0])) return;
    const { stretch, pointed } = context.time;
    const ticks = ticksOf(events.list, range, width - 2 * thumb);
    const state = JSON.stringify([width, ticks, stretch, pointed, stretch === null && pointed === null ? null : range, styleValue("--accent")]);
    if (state === drawn) return;
    drawn = state;
    const summary = summaryOf(events.list);
    canvas.setAttribute("aria-label", `events: ${summary === "" ? "none" : summary}`);
    canvas.width = Math.round(width * devicePixelRatio);
    canvas.height = Math.round(height * devicePixelRatio);
    const pen = canvas.getContext("2d")!;
    pen.scale(devicePixelRatio, devicePixelRatio);
    pen.fillStyle = styleValue("--accent");
    if (stretch !== null) {
      const [from, to] = stretch.map((time) => Math.min(width - thumb, Math.max(thumb, placeOf(time, width))));
      pen.globalAlpha = 0.35;
      pen.fillRect(from, 0, Math.max(2, to - from), height);
      pen.globalAlpha = 1;
    }
    for (const { x, kind } of ticks) {
      pen.fillStyle = styleValue(colours[kind]);
      const high = kind === "touch" ? height / 2 : height;
      pen.fillRect(thumb + x - 0.5, height - high, kind === "touch" ? 1 : 2, high);
    }
    if (pointed !== null && pointed >= range[0] && pointed <= range[1]) {
      pen.fillStyle = styleValue("--ink");
      pen.fillRect(placeOf(pointed, width) - 0.5, 0, 1, height);
    }
  }

  frame.addEventListener("pointermove", (event) => {
    const width = canvas.clientWidth, x = event.clientX - canvas.getBoundingClientRect().left;
    const near = events.list.filter((each) => Math.abs(placeOf(each.time, width) - x) <= reach);
    const [shown, more] = [near.slice(0, 4), near.length - 4];
    frame.title = [...shown.map((each) => `${Number(each.time.toPrecision(6))} s: ${each.text}`), ...(more > 0 ? [`and ${more} more`] : [])].join("\n");
  });
  const forget = [
    context.onChanged((each) => change(each.time, each.trail, each.value)),
    context.onBranch((time) => events.cutAfter(time)),
    context.onSnapshot((snapshot) => {
      if (!snapshot.past || description.kind === "movie") events.observe(snapshot);
    }),
    context.time.onChange(() => draw(range)),
    context.onTheme(() => draw(range)),
  ];
  return { element: frame, draw, dispose: () => forget.forEach((each) => each()) };
}
