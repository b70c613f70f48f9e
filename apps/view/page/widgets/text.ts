// Text: words of the file with live values where they say {0}, {1} and so on.
import type { Context, Part } from "../context.ts";
import { element, setText } from "../dom.ts";
import { formatNumber, formatUnit } from "../numbers.ts";
import type { TextWidget } from "../protocol.ts";

export function makeText(context: Context, widget: TextWidget): Part {
  const text = element("div", { class: "text", role: "group", "data-trail": widget.trail, "aria-label": widget.label });
  const unwatch: (() => void)[] = [];
  for (const part of widget.text.split(/(\{\d+\})/)) {
    const index = /^\{(\d+)\}$/.exec(part);
    const value = index === null ? undefined : widget.values[Number(index[1])];
    if (value === undefined) {
      text.append(part);
      continue;
    }
    const number = element("span", { class: "live" });
    text.append(number);
    unwatch.push(context.values.watch(value.trail, (now, unit) => {
      setText(number, `${formatNumber(now, value.digits ?? 5)} ${formatUnit(value.unit || unit)}`.trim());
    }));
  }
  return { element: text, dispose: () => unwatch.forEach((each) => each()) };
}
