// A plot laid over a camera, the one that the file names or else the first, at its lower right: values and what they are of in one look.
import type { Context } from "./context.ts";
import { element } from "./dom.ts";
import { iconButton } from "./icons.ts";
import { camerasOf, liesOver } from "./layout.ts";
import type { PlotWidget } from "./protocol.ts";

/// Adds the button to the title of a plot; the layout of the file remembers which plots lie there. The answer ends it.
export function makeLayable(context: Context, plot: HTMLElement, title: HTMLElement, widget: PlotWidget): () => void {
  const { layout } = context;
  const { trail, overlay } = widget;
  const named = context.description.windows.flatMap(camerasOf).find((each) => each.trail === overlay);
  const place = document.createComment(trail); // where it stands otherwise
  const lies = () => liesOver(layout.now, { trail, over: named !== undefined });
  const button = iconButton("over", "lay over the camera, or back", () =>
    layout.change({ over: { ...layout.now.over, [trail]: !lies() } }));
  title.append(button);
  const arrange = () => {
    const camera = (named === undefined ? null : document.querySelector(`[data-trail="${CSS.escape(named.trail)}"]`)?.closest(".camera-host")) ?? document.querySelector(".camera .camera-host");
    button.hidden = camera === null;
    button.setAttribute("aria-pressed", String(lies()));
    if (lies() === place.isConnected) return;
    if (!lies()) return place.replaceWith(plot);
    if (camera === null || !plot.isConnected) return;
    const frame = camera.querySelector(".over-camera") ?? element("div", { class: "over-camera" });
    camera.append(frame);
    plot.replaceWith(place);
    frame.append(plot);
  };
  requestAnimationFrame(arrange); // once the page stands
  return layout.onChange(arrange);
}
