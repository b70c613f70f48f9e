// Valuator.Counter: a number with a button to lower and one to raise it by its increment.
import type { Context, Part } from "../context.ts";
import { element, freshId } from "../dom.ts";
import { formatUnit } from "../numbers.ts";
import type { ValuatorWidget } from "../protocol.ts";
import { Valuator, wireNumberField } from "./valuator.ts";

export function makeCounter(context: Context, widget: ValuatorWidget): Part {
  const id = freshId();
  const number = element("input", {
    type: "text", inputmode: "decimal", id, class: "number", role: "spinbutton", "data-trail": widget.trail,
  });
  const valuator = new Valuator(context, widget, (value) => {
    const text = Number.isNaN(value) ? "" : value.toFixed(valuator.decimals);
    if (widget.range !== null) {
      number.setAttribute("aria-valuemin", String(widget.range[0]));
      number.setAttribute("aria-valuemax", String(widget.range[1]));
    }
    number.setAttribute("aria-valuenow", String(value));
    number.setAttribute("aria-valuetext", `${text} ${widget.unit}`.trim());
    if (document.activeElement !== number) number.value = text;
  });
  const count = (steps: number) => {
    // Whole increments from zero, so that 0.1 counted ten times is 1.
    const increment = widget.increment ?? 1;
    valuator.set(Number(((Math.round(valuator.value / increment) + steps) * increment).toPrecision(12)));
    number.value = valuator.value.toFixed(valuator.decimals);
  };
  number.addEventListener("keydown", (event) => {
    const steps: Record<string, number> = { ArrowUp: 1, ArrowDown: -1, PageUp: 10, PageDown: -10 };
    if (!(event.key in steps)) return;
    event.preventDefault();
    count(steps[event.key]);
  });
  const button = (text: string, name: string, steps: number) => {
    const made = element("button", { type: "button", class: "count", "aria-label": `${name} ${widget.label}` }, text);
    made.addEventListener("click", () => count(steps));
    return made;
  };
  wireNumberField(number, valuator);
  valuator.start();
  return {
    element: element("div", { class: "valuator counter" }, element("label", { for: id }, widget.label),
      button("\u2212", "lower", -1), number, button("+", "raise", 1), element("span", { class: "unit" }, formatUnit(widget.unit))),
    dispose: () => valuator.dispose(),
  };
}
