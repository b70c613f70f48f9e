// An entry of a plot's legend: its line's colour, name and present value. Pressing it hides the line or shows it again.
import { element, setText } from "../dom.ts";

export interface LegendEntry {
  element: HTMLElement;
  say(value: string, unit: string): void;
}

export function makeLegendEntry(name: string, trail: string, colour: string, shown: boolean, show: (shown: boolean) => void): LegendEntry {
  const swatch = element("span", { class: "swatch", "aria-hidden": "true" });
  swatch.style.background = colour;
  const number = element("span", { class: "number" }), unitText = element("span", { class: "unit" });
  const button = element("button", { type: "button", class: "plot-trace", title: `${trail}: hide or show`, "aria-pressed": String(shown) }, swatch, element("span", {}, name), number, unitText);
  button.addEventListener("click", () => {
    const pressed = button.getAttribute("aria-pressed") !== "true";
    button.setAttribute("aria-pressed", String(pressed));
    show(pressed);
  });
  return {
    element: button,
    say: (value, unit) => {
      setText(number, value);
      setText(unitText, unit);
    },
  };
}
