// The page's icons: lines of 1.5 pixels in a square of 16, drawn here, each named by what it does.
import { element, svgElement } from "./dom.ts";

const lines = {
  pause: "M5 3v10M11 3v10",
  run: "M4.5 2.5v11l9-5.5z",
  step: "M3.5 3v10l6-5zM12.5 3v10",
  reset: "M3.5 3v4h4M3.7 7a5 5 0 1 1-.2 3",
  picture: "M2 4.5h3l1-1.5h4l1 1.5h3v8.5H2zM8 6.2a2.3 2.3 0 1 0 .01 0",
  save: "M8 2v8M4.5 7L8 10.5 11.5 7M2.5 13.5h11",
  tree: "M2.5 3h4M5 3v10h2.5M5 8h2.5M9.5 8h4M9.5 13h4",
  theme: "M8 2a6 6 0 1 0 .01 0M8 2v12M8 5.5h4.5M8 8h6M8 10.5h5",
  help: "M8 2a6 6 0 1 0 .01 0M6.2 6.5a1.8 1.8 0 1 1 2.6 1.6q-.8.4-.8 1.4M8 11.3v.4",
  more: "M2 4.5h12M2 8h12M2 11.5h12",
  over: "M2 3h12v10H2zM7.5 8h5v3.5h-5z",
  layout: "M2.5 3h11v10h-11zM9 3v10M9 8h4.5",
  maximise: "M9.5 2.5h4v4M6.5 13.5h-4v-4M13.5 2.5L9 7M2.5 13.5L7 9",
  restore: "M13.5 6.5h-4v-4M2.5 9.5h4v4M9.5 6.5l4-4M6.5 9.5l-4 4",
  close: "M4 4l8 8M12 4l-8 8",
  copy: "M5.5 5.5h8v8h-8zM10.5 5.5v-3h-8v8h3",
  plot: "M2.5 2v11.5H14M4.5 10.5l3-4 2.5 2 3.5-5",
};
export type IconName = keyof typeof lines;

export function icon(name: IconName): SVGElement {
  return svgElement("svg", { viewBox: "0 0 16 16", class: "icon", "aria-hidden": "true" }, svgElement("path", { d: lines[name] }));
}

/// A button that shows an icon and is named, for the eye on hovering and for a screen reader always.
export function iconButton(name: IconName, title: string, press: () => void): HTMLButtonElement {
  const button = element("button", { type: "button", class: "iconic", title, "aria-label": title }, icon(name));
  button.addEventListener("click", press);
  return button;
}

export function setIcon(button: HTMLButtonElement, name: IconName, title: string): void {
  if (button.title === title) return;
  button.title = title;
  button.setAttribute("aria-label", title);
  button.replaceChildren(icon(name));
}
