// The keys of the page, and the list of them.
import { attempt, type Context } from "./context.ts";
import { element, isTyping } from "./dom.ts";
import type { Actions } from "./transport.ts";

const list: [string, string][] = [
  ["Space", "run or pause"],
  ["right arrow", "one step"],
  ["+  \u2212", "faster, slower"],
  ["r", "reset to time 0, cameras stay"],
  ["p", "picture"],
  ["t", "all values, parameters and the selected body"],
  ["?", "this list"],
  ["drag in a camera", "turn it; arrow keys do the same"],
  ["wheel in a camera", "nearer or farther"],
  ["double click", "select a body; in a plot: back from zooming"],
  ["double click on a title", "fill the page; Escape: back"],
  ["control and drag", "pull a body by a spring"],
  ["drag or wheel in a plot", "zoom all plots over time"],
  ["click in a plot", "go to that time"],
];

export function listenForKeys(context: Context, actions: Actions, toggleSide: () => void): () => void {
  const listener = (event: KeyboardEvent) => {
    const target = event.target;
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented || isTyping(target)) return;
    if (document.querySelector("dialog[open]") !== null) return;
    // A control that has the focus keeps the keys that move or press it.
    const control = target instanceof Element && target.closest("button, summary, a, input[type=checkbox], input[type=radio]") !== null;
    const moves = target instanceof Element && target.closest("input[type=range], input[type=radio], [role=slider], canvas") !== null;
    const does: Record<string, (() => void) | undefined> = {
      " ": control ? undefined : actions.toggle,
      ArrowRight: moves ? undefined : actions.step,
      "+": actions.faster, "=": actions.faster,
      "-": actions.slower, "\u2212": actions.slower,
      r: () => attempt(context, actions.reset()), p: actions.picture, t: toggleSide, "?": actions.help,
    };
    const act = does[event.key];
    if (act === undefined) return;
    event.preventDefault();
    act();
  };
  document.addEventListener("keydown", listener);
  return () => document.removeEventListener("keydown", listener);
}

export function makeHelp(version: string): HTMLDialogElement {
  const close = element("button", { type: "submit", class: "press" }, "close");
  const dialog = element("dialog", { class: "help", "aria-label": "keys" },
    element("form", { method: "dialog" }, element("h2", {}, "Keys"),
      element("table", {}, element("tbody", {}, ...list.map(([key, meaning]) => element("tr", {}, element("th", { scope: "row" }, key), element("td", {}, meaning))))),
      element("p", { class: "quiet" }, `hookpoint ${version}`), close));
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
  return dialog;
}
