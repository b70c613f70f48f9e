// Subjects side by side, so that creep is seen: each subject's displacement from its start, slip, penetration and load beside
// what is predicted for it; which of them are drawn, how much their displacements are exaggerated,
// and the displacements over time.
import type { Context, Part } from "./context.ts";
import { element, freshId, setText } from "./dom.ts";
import { engineering, formatNumber } from "./numbers.ts";
import type { PlotTrace } from "./protocol.ts";
import { makePlot } from "./widgets/plot.ts";

const measured = [
  { name: "displacement", unit: "m" },
  { name: "slip", unit: "m" },
  { name: "penetration", unit: "m" },
  { name: "load", unit: "N" },
];
const digits = 4;
const titleOfPlot = "Displacement downhill";
const greatestPower = 6;
const evenDisplacement = 1e-6; // [m]: some creep a thousand times as fast as others, and some stand

export function makeCreepPanel(context: Context): Part {
  const unwatch: (() => void)[] = [];
  const plot = makeDisplacements(context);
  // What is predicted has its column from the first prediction of a subject on.
  const heads = element("tr", { class: "quiet", hidden: true });
  const columns = measured.map((each) => {
    const head = element("th", { colspan: 1, scope: "colgroup" }, each.name);
    const subhead = element("th", { scope: "col", hidden: true }, "predicted");
    heads.append(element("th", { scope: "col" }, "now"), subhead);
    return { ...each, head, predicted: [subhead] as HTMLElement[] };
  });
  const showPredicted = ({ name, head, predicted }: (typeof columns)[number]) => {
    if (head.colSpan === 2) return;
    head.colSpan = 2;
    heads.hidden = false;
    for (const cell of predicted) cell.hidden = false;
    if (name === "displacement") setText(plot.element.querySelector(".name")!, `${titleOfPlot}, dashed: predicted`);
  };
  const number = (trail: string, unit: string, heard: (value: number) => void) => {
    const cell = element("td", { class: "number" });
    unwatch.push(context.values.watch(trail, (value) => {
      if (!Number.isNaN(value)) heard(value);
      const read = engineering(Math.abs(value), unit);
      setText(cell, Number.isNaN(value) ? formatNumber(value) : `${formatNumber(value / read.factor, digits)} ${read.unit}`);
    }));
    return cell;
  };
  const rows = context.description.subjects.map((subject, index) => {
    const id = freshId();
    const visible = element("input", { type: "checkbox", id, checked: context.visible[index] });
    visible.checked = context.visible[index];
    visible.addEventListener("change", () => context.setVisible(index, visible.checked));
    const swatch = element("span", { class: "swatch", "aria-hidden": "true" });
    swatch.style.background = subject.colour;
    const row = element("tr", { "data-trail": `Subjects[${index}]` },
      element("th", { scope: "row" }, element("span", {}, visible, element("label", { for: id, title: `draw ${subject.name}` }, swatch, subject.name))),
      ...columns.flatMap((column) => {
        const predicted = number(`Subjects[${index}].${column.name}_predicted`, column.unit, () => showPredicted(column));
        predicted.classList.add("quiet");
        predicted.hidden = column.head.colSpan === 1;
        column.predicted.push(predicted);
        return [number(`Subjects[${index}].${column.name}`, column.unit, () => {}), predicted];
      }));
    unwatch.push(context.onSnapshot((snapshot) => {
      const stopped = snapshot.subjects[index]?.fine === false;
      row.classList.toggle("stopped", stopped);
      row.title = stopped ? `${subject.name} has stopped` : "";
    }));
    return row;
  });

  const id = freshId();
  const slider = element("input", { type: "range", id, min: 0, max: greatestPower, step: "any", value: Math.log10(context.exaggeration) });
  const typed = element("output", { class: "number", for: id });
  const show = (factor: number) => {
    const text = String(Number(factor.toPrecision(3)));
    setText(typed, `\u00d7 ${text}`);
    slider.setAttribute("aria-valuetext", `times ${text}`);
    const power = Math.log10(factor);
    if (Math.abs(Number(slider.value) - power) > 1e-9) slider.value = String(power);
  };
  slider.addEventListener("input", () => context.setExaggeration(10 ** Number(slider.value)));
  unwatch.push(context.onExaggeration(show));
  show(context.exaggeration);

  const fit = element("button", { type: "button", class: "press", title: "the largest exaggeration at which all are in the picture" }, "fit");
  fit.addEventListener("click", () => context.setExaggeration(Math.min(...[...context.fits.values()].map((largest) => largest()), 10 ** greatestPower)));

  const head = element("thead", {}, element("tr", {}, element("th", { rowspan: 2, scope: "col" }, "subject"), ...columns.map((column) => column.head)), heads);
  return {
    element: element("section", { class: "window creep", role: "group", "aria-label": "side by side" }, element("h2", {}, "Side by side"),
      element("div", { class: "window-body" },
        element("div", { class: "measured" },
          element("div", { class: "table-frame", tabindex: 0 }, element("table", { class: "values subjects", "aria-label": "creep of each subject" }, head, element("tbody", {}, ...rows))),
          element("div", { class: "valuator slider" }, element("label", { for: id }, "exaggeration of displacements"), typed, fit, slider)),
        plot.element)),
    dispose: () => {
      unwatch.forEach((each) => each());
      plot.dispose();
    },
  };
}

/// The displacement of each subject in its colour, and dashed what is predicted for it.
function makeDisplacements(context: Context): Part {
  const { subjects } = context.description;
  const traces = (ending: string): PlotTrace[] => subjects.map((subject, index) => ({ x: null, y: `Subjects[${index}].displacement${ending}`, label: subject.name, unit: "m", x_unit: "s" }));
  return makePlot(context, {
    type: "Plot", trail: "displacements of the subjects", label: titleOfPlot,
    traces: [...traces("_predicted"), ...traces("")], range: null, x_range: null, window: null, overlay: null,
  }, {
    lines: [...subjects.map(({ colour }) => ({ colour, dash: [6, 5] })), ...subjects.map(({ colour }) => ({ colour }))],
    even: evenDisplacement,
  });
}
