// What stands beside a file's own windows, or beside the camera of a file without any: what its robot is judged by, all values, all
// parameters, the pose to start from, the selected body.
import type { Context, Part } from "./context.ts";
import { element } from "./dom.ts";
import { makeFieldEditor } from "./field_editor.ts";
import { iconButton } from "./icons.ts";
import { makeInspector } from "./inspector.ts";
import { makeResizeHandle } from "./resize_handle.ts";
import { makeOverview } from "./overview.ts";
import { makeStateEditor } from "./state_editor.ts";
import { makeTrailTree } from "./trail_tree.ts";

const tabs = {
  overview: { name: "Overview", make: makeOverview },
  values: { name: "Values", make: makeTrailTree },
  parameters: { name: "Parameters", make: makeFieldEditor },
  state: { name: "State", make: makeStateEditor },
  body: { name: "Body", make: makeInspector },
};
type Tab = keyof typeof tabs;
const defaultWidth = 400, leastWidth = 280; // [CSS pixels]

export function makeSidePanel(context: Context, close: () => void): Part & { show(tab: Tab): void } {
  const content = element("div", { class: "side-content", role: "tabpanel" });
  let part: Part | null = null;
  let shown: Tab | null = null;
  const buttons = (Object.keys(tabs) as Tab[]).map((tab) => {
    const button = element("button", { type: "button", role: "tab", "aria-selected": "false" }, tabs[tab].name);
    button.addEventListener("click", () => show(tab));
    return { tab, button };
  });
  function show(tab: Tab): void {
    if (tab === shown) return;
    shown = tab;
    context.kept.set("side", tab);
    part?.dispose();
    part = tabs[tab].make(context);
    content.setAttribute("aria-label", tabs[tab].name);
    content.replaceChildren(part.element);
    for (const each of buttons) each.button.setAttribute("aria-selected", String(each.tab === tab));
  }
  show((context.kept.get("side") as Tab | undefined) ?? (context.description.windows.length === 0 ? "overview" : "values"));
  const forget = context.onSelected((body) => {
    if (body !== null) show("body");
  });
  const aside: HTMLElement = element("aside", { class: "side", "aria-label": "values, parameters and the selected body" },
      makeResizeHandle({
        label: "width of the panel", along: "x", behind: true, size: () => aside.offsetWidth,
        resize: (size) => context.layout.change({ side: Math.max(leastWidth, Math.min(size, innerWidth / 2)) }), restore: () => context.layout.change({ side: null }),
      }),
      element("div", { class: "side-head" }, element("div", { role: "tablist" }, ...buttons.map((each) => each.button)), iconButton("close", "close (t)", close)),
      content);
  const arrange = () => aside.style.setProperty("--side", `${context.layout.now.side ?? defaultWidth}px`);
  arrange();
  const forgetLayout = context.layout.onChange(arrange);
  return {
    element: aside,
    show,
    dispose: () => {
      forget();
      forgetLayout();
      part?.dispose();
    },
  };
}
