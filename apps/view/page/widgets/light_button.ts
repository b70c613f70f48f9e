// Button.Light: stays down and is lit until it is pressed again.
import { attempt, type Context, type Part } from "../context.ts";
import { element } from "../dom.ts";
import type { ButtonWidget } from "../protocol.ts";

export function makeLightButton(context: Context, widget: ButtonWidget): Part {
  const button = element("button", { type: "button", class: "light", "data-trail": widget.trail, "aria-pressed": "false" },
    element("span", { class: "lamp", "aria-hidden": "true" }), widget.label);
  let lit = false;
  let unanswered = 0;
  const show = (now: boolean) => {
    lit = now;
    button.setAttribute("aria-pressed", String(now));
  };
  const unwatch = context.values.watch(widget.port, (value) => {
    if (unanswered === 0 && (value !== 0) !== lit && !Number.isNaN(value)) show(value !== 0);
  });
  button.addEventListener("click", () => {
    show(!lit);
    ++unanswered;
    attempt(context, context.connection.request("set", { values: { [widget.port]: lit ? 1 : 0 } }).finally(() => --unanswered));
  });
  return { element: button, dispose: unwatch };
}
