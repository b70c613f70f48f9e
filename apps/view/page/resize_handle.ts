// The edge between two parts of the page, dragged by the pointer or moved by arrow keys; a double click gives it back to the file.
import { element } from "./dom.ts";

const step = 16; // of an arrow key [CSS pixels]

export interface Edge {
  label: string;
  along: "x" | "y"; // where it moves to
  size(): number; // of what lies before it, or behind it where `behind` [CSS pixels]
  behind?: boolean;
  resize(size: number): void;
  restore(): void;
}

export function makeResizeHandle(edge: Edge): HTMLElement {
  const handle = element("div", {
    class: `resize-handle along-${edge.along}`, role: "separator", tabindex: 0, title: `${edge.label}: drag, arrow keys; a double click restores it`,
    "aria-label": edge.label, "aria-orientation": edge.along === "x" ? "vertical" : "horizontal",
  });
  const sign = edge.behind ? -1 : 1;
  const tell = () => handle.setAttribute("aria-valuenow", String(Math.round(edge.size())));
  let from: { place: number; size: number } | null = null;
  const placeOf = (event: PointerEvent) => (edge.along === "x" ? event.clientX : event.clientY);
  handle.addEventListener("pointerdown", (event) => {
    handle.setPointerCapture(event.pointerId);
    from = { place: placeOf(event), size: edge.size() };
  });
  handle.addEventListener("pointermove", (event) => {
    if (from === null || placeOf(event) === from.place) return;
    edge.resize(from.size + sign * (placeOf(event) - from.place));
    tell();
  });
  for (const end of ["pointerup", "pointercancel"]) handle.addEventListener(end, () => (from = null));
  handle.addEventListener("focus", tell);
  handle.addEventListener("dblclick", () => edge.restore());
  handle.addEventListener("keydown", (event) => {
    const keys: Record<string, number> = edge.along === "x" ? { ArrowLeft: -step, ArrowRight: step } : { ArrowUp: -step, ArrowDown: step };
    const by = keys[event.key];
    if (by === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    edge.resize(edge.size() + sign * by);
    tell();
  });
  return handle;
}
