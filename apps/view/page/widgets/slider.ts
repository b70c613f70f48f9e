// Valuator.Slider: an <input type=range> named by its label, its number beside it to read and to type. Where its range spans
// decades its place is the logarithm of its value. Marks stand where its value makes the run's step unstable.
import type { Context, Part } from "../context.ts";
import { element, freshId } from "../dom.ts";
import { formatUnit } from "../numbers.ts";
import type { ValuatorWidget } from "../protocol.ts";
import { sharesOf } from "../slider_marks.ts";
import { digitsOfLogarithmic, Valuator, wireNumberField, type ValueLine } from "./valuator.ts";

export function makeSlider(context: Context, widget: ValuatorWidget, line?: ValueLine): Part {
  const id = freshId();
  const range = element("input", { type: "range", id, "data-trail": widget.trail });
  const number = element("input", { type: "text", inputmode: "decimal", class: "number", "aria-label": `${widget.label}, number` });
  const valuator = new Valuator(context, widget, show, line);
  const placeOf = valuator.logarithmic ? Math.log10 : (value: number) => value;
  const valueAt = valuator.logarithmic ? (place: number) => Number((10 ** place).toPrecision(digitsOfLogarithmic)) : (place: number) => place;
  range.step = valuator.logarithmic ? "any" : String(widget.increment ?? "any");

  function show(value: number): void {
    range.min = String(placeOf(valuator.least));
    range.max = String(placeOf(valuator.greatest));
    const known = !Number.isNaN(value);
    range.disabled = !known || context.description.kind === "movie";
    if (known) range.value = String(placeOf(value));
    const text = valuator.text(value);
    range.setAttribute("aria-valuetext", `${text} ${widget.unit}`.trim());
    if (document.activeElement !== number) number.value = text;
  }
  range.addEventListener("pointerdown", () => valuator.hold(true));
  for (const end of ["pointerup", "pointercancel", "change"]) range.addEventListener(end, () => valuator.hold(false));
  range.addEventListener("input", () => valuator.set(valueAt(Number(range.value))));
  wireNumberField(number, valuator);
  const marks = element("div", { class: "unstable", hidden: "" });
  const forgetMarks = context.description.kind !== "run" || widget.range === null || line !== undefined ? () => {} : context.marks.watch(widget.port, (stretches) => {
    marks.replaceChildren(...stretches.map((stretch) => {
      const [from, to] = sharesOf(stretch, [valuator.least, valuator.greatest], placeOf);
      const mark = element("span");
      mark.style.left = `${100 * from}%`;
      mark.style.width = `${100 * (to - from)}%`;
      return mark;
    }));
    const text = stretches.map(([from, to]) => `${valuator.text(from)} to ${valuator.text(to)}`).join(" and ");
    marks.hidden = stretches.length === 0;
    range.title = stretches.length === 0 ? "" : `the step of ${context.description.deltat} s is unstable from ${`${text} ${widget.unit}`.trim()}`;
  });
  valuator.start();
  return {
    element: element("div", { class: "valuator slider" },
      element("label", { for: id }, widget.label), number, element("span", { class: "unit" }, formatUnit(widget.unit)), range, marks),
    dispose: () => {
      forgetMarks();
      valuator.dispose();
    },
  };
}
