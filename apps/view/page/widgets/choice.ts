// Button.Choice: one of several; the value is the index. Few are buttons side by side, many a list.
import { attempt, type Context, type Part } from "../context.ts";
import { element, freshId } from "../dom.ts";
import type { ChoiceWidget } from "../protocol.ts";

const mostButtons = 4;

export function makeChoice(context: Context, widget: ChoiceWidget): Part {
  const choose = (index: number) => attempt(context, context.setter.set(widget.port, index));
  const many = widget.choices.length > mostButtons;
  const made = many ? makeList(widget, choose) : makeRadios(widget, choose);
  const unwatch = context.values.watch(widget.port, (value) => {
    if (!Number.isNaN(value)) made.show(Math.round(value));
  });
  return { element: made.element, dispose: unwatch };
}

interface Choices {
  element: HTMLElement;
  show(index: number): void;
}

function makeList(widget: ChoiceWidget, choose: (index: number) => void): Choices {
  const id = freshId();
  const list = element("select", { id, "data-trail": widget.trail }, ...widget.choices.map((text, index) => element("option", { value: index }, text)));
  list.addEventListener("change", () => choose(list.selectedIndex));
  return {
    element: element("div", { class: "valuator choice" }, element("label", { for: id }, widget.label), list),
    show: (index) => {
      if (list.selectedIndex !== index) list.selectedIndex = index;
    },
  };
}

function makeRadios(widget: ChoiceWidget, choose: (index: number) => void): Choices {
  const name = freshId();
  const radios = widget.choices.map((_, index) => element("input", { type: "radio", name, value: index }));
  radios.forEach((radio, index) => radio.addEventListener("change", () => choose(index)));
  return {
    element: element("div", { class: "valuator choice", role: "radiogroup", "data-trail": widget.trail, "aria-label": widget.label },
      element("span", { class: "name", "aria-hidden": "true" }, widget.label),
      element("span", { class: "segments" }, ...widget.choices.map((text, index) => element("label", {}, radios[index], element("span", {}, text))))),
    show: (index) => radios.forEach((radio, i) => {
      if (radio.checked !== (i === index)) radio.checked = i === index;
    }),
  };
}
