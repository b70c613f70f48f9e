// Valuator.Input: a number to read and to type.
import type { Context, Part } from "../context.ts";
import { element, freshId } from "../dom.ts";
import { formatNumber, formatUnit, parseNumber } from "../numbers.ts";
import type { ValuatorWidget } from "../protocol.ts";
import { Valuator } from "./valuator.ts";

export function makeInput(context: Context, widget: ValuatorWidget): Part {
  const id = freshId();
  const number = element("input", { type: "text", inputmode: "decimal", id, class: "number wide", "data-trail": widget.trail });
  // What is typed is shown in full: a number like 0.00012345678 is not cut.
  const valuator = new Valuator(context, widget, (value) => {
    if (document.activeElement !== number) number.value = Number.isNaN(value) ? "" : String(value);
    number.title = `${formatNumber(value)} ${formatUnit(widget.unit)}`.trim();
  });
  const take = () => {
    const value = parseNumber(number.value);
    number.setAttribute("aria-invalid", String(value === null));
    if (value !== null) {
      valuator.set(value);
      number.value = String(valuator.value);
    }
  };
  number.addEventListener("focus", () => valuator.hold(true));
  number.addEventListener("change", take);
  number.addEventListener("blur", () => {
    valuator.hold(false);
    number.removeAttribute("aria-invalid");
    number.value = Number.isNaN(valuator.value) ? "" : String(valuator.value);
  });
  valuator.start();
  return {
    element: element("div", { class: "valuator input" }, element("label", { for: id }, widget.label), number,
      element("span", { class: "unit" }, formatUnit(widget.unit))),
    dispose: () => valuator.dispose(),
  };
}
