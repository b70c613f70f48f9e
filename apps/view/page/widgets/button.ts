// Button: true once it is pressed, by a pointer or by a key, until the program has seen it.
import { attempt, type Context, type Part } from "../context.ts";
import { element } from "../dom.ts";
import type { ButtonWidget } from "../protocol.ts";

export function makeButton(context: Context, widget: ButtonWidget): Part {
  const button = element("button", { type: "button", class: "press", "data-trail": widget.trail }, widget.label);
  let down = false;
  const press = (pressed: boolean) => {
    if (pressed === down) return;
    down = pressed;
    button.classList.toggle("down", pressed);
    // The program takes a press back by itself, once whatever is wired to the button has seen it.
    if (pressed) attempt(context, context.connection.request("set", { values: { [widget.port]: 1 } }));
  };
  button.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    button.setPointerCapture(event.pointerId);
    press(true);
  });
  for (const end of ["pointerup", "pointercancel", "lostpointercapture", "blur"]) button.addEventListener(end, () => press(false));
  button.addEventListener("keydown", (event) => {
    if ((event.key === "Enter" || event.key === " ") && !event.repeat) press(true);
  });
  button.addEventListener("keyup", () => press(false));
  // A screen reader clicks without pointer and key.
  button.addEventListener("click", (event) => {
    if (event.detail !== 0 || down) return;
    press(true);
    press(false);
  });
  return { element: button, dispose: () => {} };
}
