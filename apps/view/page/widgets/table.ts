// Table: raw values, a row each, live.
import type { Context, Part } from "../context.ts";
import { element, setText } from "../dom.ts";
import { formatNumber, formatUnit } from "../numbers.ts";
import type { TableWidget } from "../protocol.ts";

export interface LiveRow {
  trail: string;
  unit: string;
  label: string;
}

/// Rows of name, number and unit that follow their values.
export function makeRows(context: Context, rows: LiveRow[]): { rows: HTMLTableRowElement[]; dispose(): void } {
  const unwatch: (() => void)[] = [];
  const made = rows.map((row) => {
    const number = element("td", { class: "number" });
    const unitCell = element("td", { class: "unit" }, formatUnit(row.unit));
    unwatch.push(context.values.watch(row.trail, (value, unit) => {
      setText(number, formatNumber(value));
      if (row.unit === "") setText(unitCell, formatUnit(unit));
    }));
    return element("tr", {}, element("th", { scope: "row", title: row.trail }, row.label || row.trail), number, unitCell);
  });
  return { rows: made, dispose: () => unwatch.forEach((each) => each()) };
}

export function makeTable(context: Context, widget: TableWidget): Part {
  const live = makeRows(context, widget.rows);
  const table = element("table", { class: "values", "data-trail": widget.trail, "aria-label": widget.label }, element("tbody", {}, ...live.rows));
  const frame = element("div", { class: "table-frame", tabindex: widget.height ? 0 : null }, table);
  if (widget.height) frame.style.maxHeight = `${widget.height}px`;
  return { element: frame, dispose: live.dispose };
}
