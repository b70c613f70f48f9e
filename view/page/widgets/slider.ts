// Valuator.Slider: an <input type=range> named by its label, its number beside it to read and to type.
import type { Context, Part } from "../context.ts";
import { element, freshId } from "../dom.ts";
import { formatUnit } from "../numbers.ts";
import type { ValuatorWidget } from "../protocol.ts";
import { Valuator, wireNumberField } from "./valuator.ts";

export function makeSlider(context: Context, widget: ValuatorWidget): Part {
  const id = freshId();
  const range = element("input", { type: "range", id, "data-trail": widget.trail, step: widget.increment ?? "any" });
  const number = element("input", { type: "text", inputmode: "decimal", class: "number", "aria-label": `${widget.label}, number` });
  const valuator = new Valuator(context, widget, show);

  function show(value: number): void {
    range.min = String(valuator.least);
    range.max = String(valuator.greatest);
    const known = !Number.isNaN(value);
    range.disabled = !known;
    if (known) range.value = String(value);
    const text = known ? value.toFixed(valuator.decimals) : "";
    range.setAttribute("aria-valuetext", `${text} ${widget.unit}`.trim());
    if (document.activeElement !== number) number.value = text;
  }
  range.addEventListener("pointerdown", () => valuator.hold(true));
  for (const end of ["pointerup", "pointercancel", "change"]) range.addEventListener(end, () => valuator.hold(false));
  range.addEventListener("input", () => valuator.set(Number(range.value)));
  wireNumberField(number, valuator);
  valuator.start();
  return {
    element: element("div", { class: "valuator slider" },
      element("label", { for: id }, widget.label), number, element("span", { class: "unit" }, formatUnit(widget.unit)), range),
    dispose: () => valuator.dispose(),
  };
}
