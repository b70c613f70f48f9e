// The runs of a study as a table that fills: what was varied, the subject, what was measured beside
// its closed form, and the verdicts. It sorts by any column, and each run opens in a window.
import { element, setText } from "../dom.ts";
import { formatNumber, formatUnit, unknown } from "../numbers.ts";
import type { Cell, Column, Row, Study } from "./protocol.ts";

const digits = 4;
const markSigns = ["●", "■", "▲", "◆", "⬟"]; // of a subject's marker in the figures
const pauseOfSorting = 500; // ms: a table that is filling should not jump about

type Value = number | string | null; // of a cell, as it is sorted

interface Sortable {
  head: HTMLTableCellElement;
  value(row: number): Value;
}

export class RunTable {
  readonly element: HTMLElement;
  private readonly body = element("tbody");
  private readonly lines: HTMLTableRowElement[] = [];
  private readonly columns: Sortable[] = [];
  private sorted: { column: Sortable; down: boolean } | null = null;
  private waiting: ReturnType<typeof setTimeout> | null = null;

  constructor(private readonly study: Study, private readonly open: (row: number) => void) {
    const names = element("tr"), units = element("tr", { class: "units" });
    const add = (name: string, unit: string, text: boolean, value: (row: number) => Value) => {
      const button = element("button", { type: "button", class: "sorts" }, name);
      const head = element("th", { scope: "col", class: text ? "text" : null, "aria-sort": "none" }, button);
      const column = { head, value };
      button.addEventListener("click", () => this.sortBy(column));
      names.append(head);
      units.append(element("td", { class: text ? "text" : null }, formatUnit(unit)));
      this.columns.push(column);
    };
    const row = (index: number) => study.rows[index];
    add("run", "", false, (index) => index);
    let varied = 0, measured = 0;
    for (const column of study.columns) {
      if (!column.varied) continue;
      const at = varied++;
      add(spoken(column.name), column.unit, column.names.length > 0, (index) => nameOf(column, row(index).varied[at]) ?? row(index).varied[at]);
    }
    add("subject", "", true, (index) => study.subjects[row(index).subject].name);
    for (const column of study.columns) {
      if (column.varied) continue;
      const at = measured++;
      add(spoken(column.name), column.unit, false, (index) => row(index).cells[at]?.[0] ?? null);
    }
    add("status", "", true, (index) => statusOf(row(index)));
    study.rows.forEach((_, index) => this.lines.push(this.makeLine(index)));
    this.body.append(...this.lines);
    this.element = element("div", { class: "study-runs", tabindex: 0, role: "region", "aria-label": "runs" },
      element("table", {}, element("caption", { class: "unseen" }, `Runs of ${study.title}`), element("thead", {}, names, units), this.body));
  }

  /// The row is as `study.rows` now has it.
  update(row: number): void {
    const line = this.makeLine(row);
    line.classList.add("fresh");
    this.lines[row].replaceWith(line);
    this.lines[row] = line;
    if (this.sorted === null || this.waiting !== null) return;
    this.waiting = setTimeout(() => {
      this.waiting = null;
      this.order();
    }, pauseOfSorting);
  }

  dispose(): void {
    if (this.waiting !== null) clearTimeout(this.waiting);
  }

  private makeLine(index: number): HTMLTableRowElement {
    const { subjects, columns, rows } = this.study;
    const row = rows[index], subject = subjects[row.subject];
    const opener = element("button", { type: "button", class: "opens", title: "open this run in a window", "aria-label": `open run ${index} in a window` }, `${index}`);
    opener.addEventListener("click", () => this.open(index));
    const line = element("tr", { "data-row": index, "data-outcome": row.outcome || "waiting" }, element("td", {}, opener));
    row.varied.forEach((value, at) => {
      const name = nameOf(columns[at], value);
      line.append(element("td", { class: name === null ? null : "text" }, name ?? formatVaried(value)));
    });
    const swatch = element("span", { class: "swatch", "aria-hidden": "true" }, markSigns[subject.marker]);
    swatch.style.color = subject.colour;
    line.append(element("th", { scope: "row", class: "text", title: subject.composition }, swatch, subject.name));
    for (const cell of row.cells) line.append(makeCell(cell, row.outcome !== ""));
    line.append(element("td", { class: "text status" }, statusOf(row)));
    return line;
  }

  private sortBy(column: Sortable): void {
    this.sorted = this.sorted?.column === column ? { column, down: !this.sorted.down } : { column, down: false };
    for (const each of this.columns)
      each.head.setAttribute("aria-sort", each !== column ? "none" : this.sorted.down ? "descending" : "ascending");
    this.order();
  }

  private order(): void {
    if (this.sorted === null) return;
    const { column, down } = this.sorted;
    const order = this.lines.map((_, index) => ({ index, value: column.value(index) }));
    order.sort((a, b) => compare(a.value, b.value, down) || a.index - b.index);
    this.body.append(...order.map(({ index }) => this.lines[index]));
  }
}

/// What is not known comes last, whichever way is up.
function compare(a: Value, b: Value, down: boolean): number {
  if (a === null || b === null) return (a === null ? 1 : 0) - (b === null ? 1 : 0);
  const order = typeof a === "number" && typeof b === "number" ? a - b : String(a).localeCompare(String(b));
  return down ? -order : order;
}

function makeCell([measured, predicted, ok]: Cell, ran: boolean): HTMLTableCellElement {
  const cell = element("td", { class: ok === false ? "fails" : null });
  if (!ran) return cell;
  if (ok !== null) cell.append(element("span", { class: ok ? "good" : "bad" }, ok ? "\u2713 holds " : "\u2717 fails "));
  cell.append(measured === null ? unknown : measured === 0 ? "0" : formatNumber(measured, digits));
  if (predicted !== null) cell.append(element("small", {}, element("span", { class: "unseen" }, "predicted "), predicted === 0 ? "0" : formatNumber(predicted, digits)));
  return cell;
}

function nameOf(column: Column, value: number): string | null {
  return column.names[value] ?? null;
}

/// A value that somebody chose: as it was written.
function formatVaried(value: number): string {
  return String(Number(value.toPrecision(6))).replace("e-", "e\u2212").replace(/^-/, "\u2212");
}

function statusOf(row: Row): string {
  if (row.outcome === "") return "";
  return row.status === "ok" ? "\u2713 ok" : row.outcome === "stopped" ? `\u2717 ${row.status}` : row.status;
}

export function spoken(name: string): string {
  return name.replaceAll("_", " ");
}

/// "84 of 208, about 2 min".
export function progressText(done: number, total: number, secondsLeft: number): string {
  const left = done === 0 || done >= total ? "" : `, about ${durationText(secondsLeft)}`;
  return `${done} of ${total}${left}`;
}

function durationText(seconds: number): string {
  if (seconds < 1) return "a second";
  if (seconds < 90) return `${Math.ceil(seconds)} s`;
  if (seconds < 5400) return `${Math.round(seconds / 60)} min`;
  return `${(seconds / 3600).toFixed(1)} h`;
}

export function showProgress(bar: HTMLProgressElement, words: HTMLElement, progress: { done: number; total: number; seconds_left: number }): void {
  bar.max = Math.max(progress.total, 1);
  bar.value = progress.done;
  setText(words, progressText(progress.done, progress.total, progress.seconds_left));
}
