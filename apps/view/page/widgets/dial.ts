// Valuator.Dial: a hand on a round scale, turned by dragging, by the wheel or by keys.
import type { Context, Part } from "../context.ts";
import { element, svgElement } from "../dom.ts";
import { formatUnit } from "../numbers.ts";
import type { ValuatorWidget } from "../protocol.ts";
import { Valuator, wireNumberField } from "./valuator.ts";

const sweep = 0.75 * 2 * Math.PI; // from the least to the greatest value, open below
const radius = 26;

function pointAt(part: number, distance: number): string {
  const angle = -Math.PI / 2 + (part - 0.5) * sweep;
  return `${(32 + distance * Math.cos(angle)).toFixed(2)} ${(32 + distance * Math.sin(angle)).toFixed(2)}`;
}

export function makeDial(context: Context, widget: ValuatorWidget): Part {
  const hand = svgElement("path", { class: "dial-hand" });
  const scale = svgElement("path", { class: "dial-scale" });
  scale.setAttribute("d", [...Array(11).keys()].map((i) => `M${pointAt(i / 10, radius)}L${pointAt(i / 10, radius + 4)}`).join(""));
  const face = element("div", { class: "dial-face", role: "slider", tabindex: 0, "data-trail": widget.trail, "aria-label": widget.label },
    svgElement("svg", { viewBox: "0 0 64 64", "aria-hidden": "true" },
      scale, svgElement("circle", { class: "dial-ring", cx: 32, cy: 32, r: radius - 3 }), hand));
  const number = element("input", { type: "text", inputmode: "decimal", class: "number", "aria-label": `${widget.label}, number` });
  const valuator = new Valuator(context, widget, (value) => {
    const known = !Number.isNaN(value);
    const text = known ? value.toFixed(valuator.decimals) : "";
    face.setAttribute("aria-valuemin", String(valuator.least));
    face.setAttribute("aria-valuemax", String(valuator.greatest));
    if (known) face.setAttribute("aria-valuenow", String(value));
    face.setAttribute("aria-valuetext", `${text} ${widget.unit}`.trim());
    const part = known ? (value - valuator.least) / (valuator.greatest - valuator.least) : 0;
    hand.setAttribute("d", known ? `M${pointAt(part, 8)}L${pointAt(part, radius - 5)}` : "");
    if (document.activeElement !== number) number.value = text;
  });

  const turn = (event: PointerEvent) => {
    const frame = face.getBoundingClientRect();
    const x = event.clientX - frame.left - frame.width / 2;
    const y = event.clientY - frame.top - frame.height / 2;
    const part = Math.atan2(x, -y) / sweep + 0.5;
    valuator.set(valuator.least + Math.min(1, Math.max(0, part)) * (valuator.greatest - valuator.least));
  };
  face.addEventListener("pointerdown", (event) => {
    face.setPointerCapture(event.pointerId);
    valuator.hold(true);
    turn(event);
  });
  face.addEventListener("pointermove", (event) => {
    if (face.hasPointerCapture(event.pointerId)) turn(event);
  });
  for (const end of ["pointerup", "pointercancel"]) face.addEventListener(end, () => valuator.hold(false));
  face.addEventListener("wheel", (event) => {
    if (document.activeElement !== face) return; // the wheel over a dial that is not in hand scrolls the page
    event.preventDefault();
    valuator.set(valuator.value - Math.sign(event.deltaY) * valuator.increment);
  }, { passive: false });
  face.addEventListener("keydown", (event) => {
    const steps: Record<string, number> = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10 };
    if (event.key === "Home") valuator.set(valuator.least);
    else if (event.key === "End") valuator.set(valuator.greatest);
    else if (event.key in steps) valuator.set(valuator.value + steps[event.key] * valuator.increment);
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
  wireNumberField(number, valuator);
  valuator.start();
  return {
    element: element("div", { class: "valuator dial" }, face,
      element("span", { class: "name" }, widget.label),
      element("span", { class: "reading" }, number, element("span", { class: "unit" }, formatUnit(widget.unit)))),
    dispose: () => valuator.dispose(),
  };
}
