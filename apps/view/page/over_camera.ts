// A plot laid over the first camera, at its lower right: values and what they are of in one look.
import type { Context } from "./context.ts";
import { element } from "./dom.ts";
import { iconButton } from "./icons.ts";

/// Adds the button to the title of a plot; the layout of the file remembers which plots lie there. The answer ends it.
export function makeLayable(context: Context, plot: HTMLElement, title: HTMLElement, trail: string): () => void {
  const { layout } = context;
  const place = document.createComment(trail); // where it stands otherwise
  const lies = () => layout.now.over.includes(trail);
  const button = iconButton("over", "lay over the camera, or back", () =>
    layout.change({ over: lies() ? layout.now.over.filter((each) => each !== trail) : [...layout.now.over, trail] }));
  title.append(button);
  const arrange = () => {
    const camera = document.querySelector(".camera .camera-host");
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
