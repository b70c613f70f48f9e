// A figure of two swept values: a table whose cells are coloured by what was measured there, thick
// lines where the closed form changes between neighbours.
import { element } from "../dom.ts";
import { formatNumber, formatUnit, unknown } from "../numbers.ts";
import type { Axis, MapFigure } from "./protocol.ts";

type Colour = [number, number, number];
const low: Colour = [246, 178, 107], middle: Colour = [247, 243, 232], high: Colour = [127, 184, 230]; // as in the report

export class MapView {
  readonly element = element("div", { class: "study-maps" });

  constructor(figure: MapFigure) {
    this.update(figure);
  }

  update(figure: MapFigure): void {
    const values = figure.panels.flatMap((panel) => panel.values).filter((value): value is number => value !== null);
    const least = place(figure.colour, values.reduce((a, b) => Math.min(a, b), Infinity));
    const greatest = place(figure.colour, values.reduce((a, b) => Math.max(a, b), -Infinity));
    const part = (value: number) => (greatest > least ? (place(figure.colour, value) - least) / (greatest - least) : 0.5);
    this.element.replaceChildren(...figure.panels.map((panel) => {
      const columns = figure.x_values.length;
      const lines = figure.y_values.map((y, row) => {
        const line = element("tr", {}, element("th", { scope: "row" }, short(y)));
        figure.x_values.forEach((_, column) => {
          const at = row * columns + column, value = panel.values[at];
          const cell = element("td", {}, value === null ? unknown : formatNumber(value, 3));
          if (value !== null) cell.style.background = colourAt(part(value));
          const differs = (other: number) => panel.predicted[at] !== null && panel.predicted[other] !== null && panel.predicted[at] !== panel.predicted[other];
          cell.classList.toggle("edge-right", column + 1 < columns && differs(at + 1));
          cell.classList.toggle("edge-top", row + 1 < figure.y_values.length && differs(at + columns));
          line.append(cell);
        });
        return line;
      });
      const foot = element("tr", {}, element("td"), ...figure.x_values.map((x) => element("th", { scope: "col" }, short(x))));
      return element("table", {},
        element("caption", {}, `${panel.title}${panel.title === "" ? "" : ": "}${named(figure.colour)}; ${named(figure.y)} up, ${named(figure.x)} across`),
        element("tbody", {}, ...lines.reverse()), element("tfoot", {}, foot));
    }));
  }

  redraw(): void {}
  dispose(): void {}
}

function place(axis: Axis, value: number): number {
  return axis.logarithmic ? Math.log10(Math.max(Math.abs(value), axis.floor)) : value;
}

function colourAt(part: number): string {
  const [from, to, along] = part < 0.5 ? [low, middle, 2 * part] : [middle, high, 2 * part - 1];
  return `rgb(${from.map((each, i) => Math.round(each + along * (to[i] - each))).join(" ")})`;
}

function short(value: number): string {
  return String(Number(value.toPrecision(6))).replaceAll("-", "\u2212");
}

function named(axis: Axis): string {
  return axis.unit === "" ? axis.label : `${axis.label} [${formatUnit(axis.unit)}]`;
}
