// The bar that is always there: run and pause, step, speed, reset, the time and its history, and
// what else concerns the whole run.
import { attempt, type Context, type Part, type Quality } from "./context.ts";
import { download, element, setText } from "./dom.ts";
import { makeEventTicks } from "./event_ticks.ts";
import { makeLayoutMenu } from "./layout_menu.ts";
import { iconButton, setIcon } from "./icons.ts";
import { decimalsOfTime, formatDecimals, formatSpeed } from "./numbers.ts";
import type { Description, Snapshot } from "./protocol.ts";

/// Factors of real time that the keys and the list go through; 0 is as fast as possible.
export const speeds = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 100, 1000, 0];

/// The speed before or after one in the list.
export function neighbouringSpeed(speed: number, by: 1 | -1): number {
  const rank = (factor: number) => (factor === 0 ? Infinity : factor);
  const others = speeds.filter((each) => (by > 0 ? rank(each) > rank(speed) * (1 + 1e-9) : rank(each) < rank(speed) * (1 - 1e-9)));
  if (others.length === 0) return speed;
  return by > 0 ? others[0] : others[others.length - 1];
}

/// What a page does where playing has come to its end: nothing, begin anew, or go on beyond.
const endings = { stop: "stops at the end", again: "begins again", on: "goes on" } as const;
type Ending = keyof typeof endings;
const keyOfEnding = "hookpoint.ending";
const timeAtEnd = 700; // [ms] that the end is seen before it begins again

/// Whether a snapshot shows that playing has just come to the end.
export function cameToEnd(description: Description, before: Snapshot | null, now: Snapshot): boolean {
  if (before === null || before.paused || !now.paused || now.ended) return false;
  if (description.kind === "movie") return now.time > now.historyLast - description.deltat / 2;
  return description.holds && !now.past && Math.abs(now.time - (description.duration ?? Infinity)) < description.deltat / 2;
}

export interface Actions {
  toggle(): void;
  step(): void;
  faster(): void;
  slower(): void;
  reset(): Promise<unknown>;
  picture(): void;
  help(): void;
}

export interface Chrome {
  theme(): void;
  help(): void;
  openSide(): void;
}

export function makeTransport(context: Context, chrome: Chrome): Part & { actions: Actions } {
  const { connection, description } = context;
  const movie = description.kind === "movie";
  const decimals = decimalsOfTime(description.deltat);
  let shown: Snapshot | null = null;
  let speed = 1;

  /// Nothing follows: what runs, runs from the beginning.
  const over = (): boolean => shown !== null && shown.ended && !movie;

  const actions: Actions = {
    toggle: () => attempt(context, over() ? actions.reset().then(() => connection.request("run", {})) : connection.request(shown === null || shown.paused ? "run" : "pause", {})),
    step: () => attempt(context, connection.request("step", { count: 1 })),
    faster: () => setSpeed(neighbouringSpeed(speed, 1)),
    slower: () => setSpeed(neighbouringSpeed(speed, -1)),
    reset: () => {
      context.resets.tell();
      return connection.request("reset", {});
    },
    picture: () => attempt(context, takePictures(context)),
    help: chrome.help,
  };

  const run = iconButton("run", "run (Space)", actions.toggle);
  run.classList.add("main");
  const step = iconButton("step", "one step (right arrow)", actions.step);
  const reset = iconButton("reset", movie ? "to the beginning (r)" : "reset to time 0 (r)", () => attempt(context, actions.reset()));
  const time = element("output", { class: "time", "aria-live": "off", "aria-label": "time" });
  const state = element("span", { class: "state", role: "status" });
  const work = element("span", { class: "state", role: "status" });
  const scrubber = element("input", { type: "range", class: "scrubber", step: "any", "aria-label": movie ? "time line" : "history", min: 0, max: 1 });
  scrubber.disabled = true;
  if (!description.history.possible && description.history.why !== "") scrubber.title = description.history.why;

  const asked = element("select", { "aria-label": "speed", title: "speed, as a factor of real time (+ and \u2212)" },
    ...speeds.map((each) => element("option", { value: each }, each === 0 ? formatSpeed(0) : `\u00d7 ${formatSpeed(each)}`)));
  const reached = element("span", { class: "reached", title: "speed that is reached" });
  asked.addEventListener("change", () => setSpeed(Number(asked.value)));
  function setSpeed(factor: number): void {
    showSpeed(factor);
    attempt(context, connection.request("speed", { factor }));
  }
  function showSpeed(factor: number): void {
    speed = factor;
    const known = [...asked.options].some((option) => Number(option.value) === factor);
    if (!known) asked.append(element("option", { value: factor }, `\u00d7 ${formatSpeed(factor)}`));
    if (Number(asked.value) !== factor) asked.value = String(factor);
  }

  const ending = element("select", { "aria-label": "at the end", title: "what playing does at the end" },
    ...(Object.keys(endings) as Ending[]).filter((each) => !(movie && each === "on")).map((each) => element("option", { value: each }, endings[each])));
  ending.value = localStorage.getItem(keyOfEnding) ?? (description.recorded ? "again" : "stop");
  if (ending.selectedIndex < 0) ending.value = "stop";
  ending.addEventListener("change", () => localStorage.setItem(keyOfEnding, ending.value));
  let returning = 0;
  function finish(): void {
    if (ending.value === "on") attempt(context, connection.request("run", {}));
    if (ending.value !== "again") return;
    returning = window.setTimeout(() => {
      if (shown === null || !shown.paused || ending.value !== "again") return;
      if (movie) attempt(context, connection.request("seek", { time: 0 }).then(() => connection.request("run", {})));
      else attempt(context, actions.reset().then(() => connection.request("run", {})));
    }, timeAtEnd);
  }

  const ticks = makeEventTicks(context, scrubber);
  let held = false;
  scrubber.addEventListener("pointerdown", () => (held = true));
  for (const end of ["pointerup", "pointercancel", "change"]) scrubber.addEventListener(end, () => (held = false));
  scrubber.addEventListener("input", () => context.seeker.seek(Number(scrubber.value)));

  const quality = element("select", { "aria-label": "quality of the picture", title: "quality of the picture" },
    ...(["low", "medium", "high"] as Quality[]).map((each) => element("option", { value: each, selected: each === context.quality }, each)));
  quality.addEventListener("change", () => (context.quality = quality.value as Quality));

  const save = iconButton("save", "save what was changed as a .hook patch", () => attempt(context, (async () => {
    const patch = await connection.request("patch", {});
    download(patch.name, new Blob([patch.text], { type: "text/plain" }));
  })()));
  const element_ = element("header", { class: "transport" },
    element("span", { class: "title", title: `${description.world}: ${description.engine}, ${description.law}, ${description.integrator}` }, description.title),
    element("span", { class: "group", role: "group", "aria-label": "transport" }, reset, run, step),
    element("span", { class: "clock" }, time, element("span", { class: "unit" }, "s"), state),
    ticks.element,
    work,
    element("span", { class: "group", role: "group", "aria-label": "speed" }, asked, reached, ...(movie || description.holds ? [ending] : [])),
    element("span", { class: "group tools", role: "group", "aria-label": "tools" },
      quality,
      iconButton("picture", "picture (p)", actions.picture),
      ...(movie ? [] : [save]),
      makeLayoutMenu(context),
      iconButton("tree", "all values, parameters and the selected body (t)", chrome.openSide),
      iconButton("theme", "light or dark", chrome.theme),
      iconButton("help", "keys (?)", chrome.help)));

  // Parts that stay in sight stand below the bar, however many rows it has.
  const below = new ResizeObserver(() => document.documentElement.style.setProperty("--bar", `${element_.offsetHeight}px`));
  below.observe(element_);
  const forgetWork = context.onProgress((name, done) => setText(work, done < 1 ? `${name}: ${Math.floor(100 * done)} %` : ""));
  const forget = context.onSnapshot((snapshot) => {
    const end = cameToEnd(description, shown, snapshot);
    shown = snapshot;
    if (end) finish();
    if (over()) setIcon(run, "run", "begin again (Space)");
    else setIcon(run, snapshot.paused ? "run" : "pause", snapshot.paused ? (snapshot.past && !movie ? "go on from here (Space)" : "run (Space)") : "pause (Space)");
    step.disabled = over();
    setText(time, formatDecimals(snapshot.time, decimals));
    setText(state, snapshot.failed ? "stopped: failed" : snapshot.ended ? "ended" : snapshot.past && !movie ? "past" : "");
    showSpeed(snapshot.speedAsked);
    setText(reached, snapshot.paused || snapshot.ended ? "" : `\u00d7 ${snapshot.speedReached.toPrecision(3)}`);
    const possible = snapshot.historyLast > snapshot.historyFirst;
    if (scrubber.disabled === possible) scrubber.disabled = !possible;
    if (!held && !context.seeker.busy) {
      scrubber.min = String(snapshot.historyFirst);
      scrubber.max = String(Math.max(snapshot.historyLast, snapshot.past ? 0 : snapshot.time));
      scrubber.value = String(snapshot.time);
      scrubber.setAttribute("aria-valuetext", `${formatDecimals(snapshot.time, decimals)} s`);
    }
    ticks.draw([Number(scrubber.min), Number(scrubber.max)]);
  });
  return { element: element_, actions, dispose: () => {
    window.clearTimeout(returning);
    ticks.dispose();
    below.disconnect();
    forget();
    forgetWork();
  } };
}

/// A picture of every camera: into the run's folder, and where that cannot be, to the user.
export async function takePictures(context: Context): Promise<void> {
  if (context.pictures.size === 0) throw new Error("there is no camera to take a picture of");
  for (const [trail, take] of context.pictures) {
    const picture = await take();
    const name = `${trail.replace(/[^\w.-]+/g, "_")}_${(context.latest?.time ?? 0).toFixed(3)}s.png`;
    try {
      const { path } = await context.connection.request("picture", { name, png: await base64Of(picture) });
      context.notice("note", `picture: ${path}`);
    } catch {
      download(name, picture);
    }
  }
}

export function base64Of(blob: Blob): Promise<string> {
  return new Promise((resolve, reject) => {
    const reader = new FileReader();
    reader.onload = () => resolve(String(reader.result).replace(/^[^,]*,/, ""));
    reader.onerror = () => reject(new Error("the picture could not be read"));
    reader.readAsDataURL(blob);
  });
}
