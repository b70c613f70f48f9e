// The page of studies: each one's progress, its figures and the table of its runs, which fill while
// it runs. A run is opened in a window of its own.
import type { Part } from "./context.ts";
import { element, setText } from "./dom.ts";
import { CurvesView } from "./study/curves.ts";
import { MapView } from "./study/map.ts";
import type { Figure, OpenRequest, State, StudiesDescription, Study, StudyTold } from "./study/protocol.ts";
import { RunTable, showProgress } from "./study/table.ts";

/// What of the line to the program is used.
export interface StudyLine {
  request(name: "open", fields: OpenRequest["with"]): Promise<OpenRequest["answer"]>;
}

export interface StudyPage extends Part {
  hear(message: StudyTold): void;
}

/// `onTheme`: has a listener called after a change of light and dark. `problem`: tells the user what went wrong.
export function makeStudyPage(
  line: StudyLine, description: StudiesDescription, onTheme: (listener: () => void) => () => void, problem: (text: string) => void,
): StudyPage {
  const open = (study: number, row: number) => openRun(line, study, row, problem);
  const views = description.studies.map((study, index) => new StudyView(study, (row) => open(index, row)));
  const tabs = views.map((view, index) => {
    const tab = element("button", { type: "button", role: "tab", id: `study-tab-${index}`, "aria-controls": `study-${index}` }, view.study.title);
    tab.addEventListener("click", () => {
      chosen = true;
      show(index);
    });
    view.element.id = `study-${index}`;
    view.element.setAttribute("role", "tabpanel");
    view.element.setAttribute("aria-labelledby", tab.id);
    return tab;
  });
  const bar = element("div", { class: "study-tabs", role: "tablist", "aria-label": "studies" }, ...tabs);
  bar.hidden = views.length === 1;
  bar.addEventListener("keydown", (event) => {
    const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (step === 0) return;
    chosen = true;
    show((shown + step + views.length) % views.length);
    tabs[shown].focus();
    event.preventDefault();
  });
  let chosen = false; // by the user; until then the study that runs is shown
  let shown = 0;
  const show = (index: number) => {
    shown = index;
    views.forEach((view, each) => (view.element.hidden = each !== index));
    tabs.forEach((tab, each) => {
      tab.setAttribute("aria-selected", String(each === index));
      tab.tabIndex = each === index ? 0 : -1;
    });
  };
  const mark = (index: number) => (tabs[index].dataset.state = views[index].study.state);
  views.forEach((_, index) => mark(index));
  show(Math.max(0, views.findIndex((view) => view.study.state === "running")));
  const page = element("main", { class: "study", "data-trail": "study" }, bar, ...views.map((view) => view.element));
  const forget = onTheme(() => views.forEach((view) => view.redraw()));
  return {
    element: page,
    hear(message) {
      const view = views[message.study];
      switch (message.tell) {
        case "row": return view.setRow(message.row, message);
        case "figure": return view.setFigure(message.figure, message);
        case "progress":
          Object.assign(view.study.progress, message);
          return view.showProgress();
        case "state":
          view.setState(message);
          mark(message.study);
          if (!chosen && message.state === "running") show(message.study);
      }
    },
    dispose: () => {
      forget();
      views.forEach((view) => view.dispose());
    },
  };
}

/// In a tab that is opened at once: later, a browser would take it for an advertisement.
function openRun(line: StudyLine, study: number, row: number, problem: (text: string) => void): void {
  const tab = window.open("", "_blank");
  line.request("open", { study, row }).then(
    ({ url }) => {
      const address = new URL(url);
      address.hostname = location.hostname; // the program's machine, as it is called from here
      if (tab === null) problem(`the browser lets the page open no tab: the run is at ${address.href}`);
      else {
        tab.opener = null;
        tab.location.replace(address.href);
      }
    },
    (refused: Error) => {
      tab?.close();
      problem(refused.message);
    });
}

class StudyView {
  readonly element: HTMLElement;
  private readonly table: RunTable;
  private readonly figures: FigureView[];
  private readonly bar = element("progress");
  private readonly words = element("span", { role: "status" });
  private readonly verdict = element("p", { class: "study-verdict" });

  constructor(readonly study: Study, open: (row: number) => void) {
    this.table = new RunTable(study, open);
    this.figures = study.figures.map((figure) => new FigureView(figure));
    this.bar.setAttribute("aria-label", `runs of ${study.title} that are done`);
    this.element = element("section", {},
      element("header", {}, element("h1", {}, study.title), element("p", { class: "study-question" }, study.question),
        element("div", { class: "study-progress" }, this.bar, this.words), this.verdict),
      element("div", { class: "study-figures" }, ...this.figures.map((view) => view.element)),
      element("p", { class: "study-note" }, "In small figures: the closed form. A run's number opens it in a window."),
      this.table.element);
    this.showProgress();
  }

  setRow(index: number, row: Study["rows"][number]): void {
    this.study.rows[index] = row;
    this.table.update(index);
    this.showVerdict();
  }
  setFigure(index: number, figure: Figure): void {
    this.study.figures[index] = figure;
    this.figures[index].update(figure);
  }
  setState({ state, report }: State): void {
    Object.assign(this.study, { state, report });
    this.showProgress();
  }
  showProgress(): void {
    showProgress(this.bar, this.words, this.study.progress);
    if (this.study.state === "interrupted") setText(this.words, `interrupted at ${this.words.textContent}`);
    this.showVerdict();
  }
  redraw(): void {
    for (const figure of this.figures) figure.redraw();
  }
  dispose(): void {
    this.table.dispose();
    for (const figure of this.figures) figure.dispose();
  }

  private showVerdict(): void {
    const verdicts = this.study.rows.flatMap((row) => row.cells.map(([, , ok]) => ok)).filter((ok) => ok !== null);
    const failed = verdicts.filter((ok) => !ok).length;
    const stopped = this.study.rows.filter((row) => row.outcome === "stopped").length;
    const parts = [];
    if (verdicts.length > 0) parts.push(failed === 0 ? `\u2713 ${verdicts.length} verdicts hold` : `\u2717 ${failed} of ${verdicts.length} verdicts fail`);
    if (stopped > 0) parts.push(`\u2717 ${stopped} ${stopped === 1 ? "run" : "runs"} stopped on the way`);
    if (this.study.report !== "") parts.push(`report: ${this.study.report}`);
    setText(this.verdict, parts.join("; "));
    this.verdict.classList.toggle("bad", failed + stopped > 0);
  }
}

class FigureView {
  readonly element: HTMLElement;
  private view: CurvesView | MapView;
  private readonly heading = element("h3");
  private readonly caption = element("figcaption");

  constructor(figure: Figure) {
    this.view = figure.kind === "map" ? new MapView(figure) : new CurvesView(figure);
    this.element = element("figure", { "data-figure": figure.name }, this.heading, this.view.element, this.caption);
    this.element.classList.toggle("wide", figure.panels.length > 1);
    this.describe(figure);
  }

  update(figure: Figure): void {
    if (figure.kind === "map" && this.view instanceof MapView) this.view.update(figure);
    if (figure.kind === "curves" && this.view instanceof CurvesView) this.view.update(figure);
    this.describe(figure);
  }
  redraw(): void {
    this.view.redraw();
  }
  dispose(): void {
    this.view.dispose();
  }

  private describe(figure: Figure): void {
    setText(this.heading, figure.title);
    setText(this.caption, figure.caption);
  }
}
