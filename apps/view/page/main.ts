// The page: it listens to the program, makes itself anew for each description, and draws the newest
// snapshot once a frame of the screen.
import { addressOfSocket, Connection, type Socket } from "./connection.ts";
import { Listeners, type Context, type Part, type Quality } from "./context.ts";
import { element } from "./dom.ts";
import { makeFilmPage } from "./film.ts";
import { offerApi } from "./hookpoint_api.ts";
import { LayoutStore } from "./layout.ts";
import { Notices } from "./notices.ts";
import { answerPictureRequest } from "./picture_request.ts";
import { protocolVersion, type Changed, type Description, type PlotTrace, type Snapshot, type Told } from "./protocol.ts";
import { readRecording, RecordedSocket } from "./recording.ts";
import { makeRunPage } from "./run_page.ts";
import { Seeker } from "./seeker.ts";
import { Branches } from "./series.ts";
import { SharedTime } from "./shared_time.ts";
import { SliderMarks } from "./slider_marks.ts";
import { makeStudyPage, type StudyPage } from "./study.ts";
import type { StudiesDescription } from "./study/protocol.ts";
import { startTheme } from "./theme.ts";
import { Setter, WatchedValues } from "./values.ts";
import { overlaysOf } from "./widgets/window.ts";

const notices = new Notices();
const host = element("div", { class: "host" }, element("p", { class: "waiting", role: "status" }, "connecting"));
document.body.append(host, notices.element);

const snapshots = new Listeners<[Snapshot]>();
const branchings = new Listeners<[number]>();
const themes = new Listeners<[]>();
const changes = new Listeners<[Changed]>();
const progresses = new Listeners<[string, number]>();
const qualities = new Listeners<[Quality]>();
const exaggerations = new Listeners<[number]>();
const visibilities = new Listeners<[number, boolean]>();
const selections = new Listeners<[number | null]>();
const kept = new Map<string, unknown>();

let page: Part | null = null;
let context: Context | null = null;
let studies: StudyPage | null = null; // the page, where it is one of studies
let described = ""; // the description that the page was made for
let newest: Snapshot | null = null;
let lastStep = 0; // that was drawn
let branches = new Branches();
let quality: Quality = "medium";

const recorded = document.getElementById("recording")?.textContent ?? null;
const recording = recorded === null ? null : readRecording(recorded);
const openSocket = (): Socket => (recording === null ? (new WebSocket(addressOfSocket(location)) as unknown as Socket) : new RecordedSocket(recording));
const connection = new Connection(openSocket, {
  told: hear,
  snapshot: (snapshot) => {
    const waiting = newest !== null;
    newest = snapshot;
    if (!waiting) requestAnimationFrame(draw);
  },
  connected: (yes) => notices.setConnected(yes),
  problem: (text) => notices.add("warning", text),
});
const values = new WatchedValues(() => connection, (text) => notices.add("warning", text));
const setter = new Setter(() => connection);
const seeker = new Seeker(() => connection, (text) => notices.add("error", text));
startTheme(() => themes.tell());
offerApi(connection, () => context, () => studies !== null);

function hear(message: Told): void {
  switch (message.tell) {
    case "description": return message.kind === "study" ? describeStudies(message) : describe(message);
    case "layout": return values.setLayout(message);
    case "notice": return notices.add(message.level, message.text);
    case "ended": return notices.setEnded(message.reason);
    case "working": return progresses.tell(message.of, message.done);
    case "changed":
      context?.marks.changed();
      return changes.tell(message);
    case "row":
    case "figure":
    case "progress":
    case "state": return studies?.hear(message);
  }
}

function announce(description: Description | StudiesDescription): void {
  if (description.protocol !== protocolVersion)
    notices.add("error", `the program speaks protocol ${description.protocol} and this page ${protocolVersion}: load the page again`);
  document.title = `${description.title} \u2013 hookpoint`;
}

function describeStudies(description: StudiesDescription): void {
  announce(description);
  const scrolled = document.scrollingElement?.scrollTop ?? 0;
  page?.dispose();
  context = null;
  page = studies = makeStudyPage(connection, description, themes.add, (text) => notices.add("error", text));
  host.replaceChildren(page.element);
  document.scrollingElement?.scrollTo(0, scrolled);
}

function describe(description: Description): void {
  notices.mark();
  announce(description);
  branches = new Branches();
  newest = null;
  // Where the run starts from another pose, it is the same file.
  const text = JSON.stringify(description, (key, value: unknown) => (key === "start" ? undefined : value));
  if (text === described && page !== null) {
    context?.description.scene.bodies.forEach((body, index) => {
      Object.assign(body, { start: description.scene.bodies[index].start });
    });
    // The same run, or one of the same file: the page stays as it is, its records are another's.
    branchings.tell(-Infinity);
    context?.marks.changed();
    values.askAnew();
    return;
  }
  described = text;
  studies = null;
  const scrolled = document.scrollingElement?.scrollTop ?? 0;
  page?.dispose();
  context = makeContext(description);
  page = description.kind === "film" ? makeFilmPage(context) : makeRunPage(context, themes);
  host.replaceChildren(page.element);
  document.scrollingElement?.scrollTo(0, scrolled);
  values.askAnew();
  answerPictureRequest(context).catch((problem: Error) => notices.add("error", problem.message));
}

function draw(): void {
  const snapshot = newest;
  newest = null;
  if (snapshot === null || context === null) return;
  if (snapshot.step < lastStep && !snapshot.past) notices.clearEarlier();
  lastStep = snapshot.step;
  context.latest = snapshot;
  const branch = branches.observe(snapshot.time, snapshot.past);
  if (branch !== null) branchings.tell(branch);
  values.draw(snapshot);
  snapshots.tell(snapshot);
}

/// A body or a subject by what it was before, where there is still one of that index.
function makeContext(description: Description): Context {
  const before = context;
  const made: Context = {
    description, connection, values, setter, kept,
    latest: null,
    onSnapshot: snapshots.add,
    onBranch: branchings.add,
    onTheme: themes.add,
    onChanged: changes.add,
    time: new SharedTime(),
    seeker,
    marks: new SliderMarks(connection),
    layout: new LayoutStore(`hookpoint.layout ${description.title}`, localStorage),
    onProgress: progresses.add,
    resets: new Listeners(),
    notice: (level, text) => notices.add(level, text),
    get quality() {
      return quality;
    },
    set quality(chosen: Quality) {
      quality = chosen;
      qualities.tell(chosen);
    },
    onQuality: qualities.add,
    exaggeration: before?.exaggeration ?? 1,
    onExaggeration: exaggerations.add,
    setExaggeration: (factor) => {
      made.exaggeration = factor;
      exaggerations.tell(factor);
    },
    visible: description.subjects.map((_, index) => before?.visible[index] ?? true),
    onVisible: visibilities.add,
    setVisible: (subject, visible) => {
      made.visible[subject] = visible;
      visibilities.tell(subject, visible);
    },
    selected: before !== null && before.selected !== null && before.selected < description.scene.bodies.length ? before.selected : null,
    onSelected: selections.add,
    select: (body) => {
      made.selected = body;
      selections.tell(body);
    },
    overlays: overlaysOf(description.windows),
    plot: (_trace: PlotTrace) => {},
    pictures: new Map(),
    fits: new Map(),
  };
  return made;
}
