// Gives a part of the page an edge at its foot that makes it higher or lower; the layout of the file remembers how high.
import type { Context } from "./context.ts";
import { leastHeight } from "./layout.ts";
import { makeResizeHandle } from "./resize_handle.ts";

/// `part` becomes as high as the layout says for `trail`, or else `own` pixels; the answer ends it.
export function makeHeightResizable(context: Context, frame: HTMLElement, part: HTMLElement, trail: string, own: number): () => void {
  const { layout } = context;
  const arrange = () => {
    const chosen = layout.now.heights[trail];
    part.style.height = `${chosen ?? own}px`;
    part.style.flex = chosen === undefined ? "" : "none";
    part.style.maxHeight = chosen === undefined ? "" : "none";
  };
  const restore = () => {
    const { [trail]: _, ...heights } = layout.now.heights;
    layout.change({ heights });
  };
  frame.append(makeResizeHandle({
    label: "height", along: "y", size: () => part.offsetHeight,
    resize: (height) => layout.change({ heights: { ...layout.now.heights, [trail]: Math.max(leastHeight, height) } }), restore,
  }));
  arrange();
  return layout.onChange(arrange);
}
