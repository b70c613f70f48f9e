// What the pointer does in a plot over time: the wheel zooms, a click goes to that time.
import type uPlot from "uplot";
import type { Context } from "../context.ts";
import type { Range } from "../protocol.ts";
import { within, zoomedAbout } from "../shared_time.ts";

const wheelFactor = 1.0015; // for one pixel of the wheel
const pixelsOfLine = 16;
const doubleClickTime = 250; // [ms] in which a click may become a double click
const scrollTime = 250; // [ms] in which a wheel that scrolls goes on scrolling
const leastSteps = 4; // of the run, in a stretch

export interface PlotTimes {
  shown(): Range;
  /// From the first to the last known time.
  whole(): Range;
}

/// The wheel zooms all plots about the time under the pointer, and moves them along time where it turns sideways or shift is held.
/// Where nothing is zoomed, or the page is being scrolled, the wheel stays the page's. The answer ends it.
export function wheelZooms(chart: uPlot, context: Context, times: PlotTimes): () => void {
  let scrolled = -Infinity; // when the page or a part of it was scrolled last
  const onScroll = () => (scrolled = performance.now());
  document.addEventListener("scroll", onScroll, { capture: true, passive: true });
  chart.over.addEventListener("wheel", (event) => {
    if (event.ctrlKey || performance.now() - scrolled < scrollTime) return;
    const pixels = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? pixelsOfLine : 1;
    const [across, down] = event.shiftKey ? [event.deltaX + event.deltaY, 0] : [event.deltaX, event.deltaY];
    const [begin, end] = times.shown();
    if (Math.abs(across) > Math.abs(down)) {
      if (context.time.stretch === null) return;
      const by = ((across * pixels) / chart.over.clientWidth) * (end - begin);
      context.time.show(within([begin + by, end + by], times.whole()));
    } else {
      if (context.time.stretch === null && down >= 0) return;
      const about = chart.posToVal(event.offsetX, "x");
      context.time.show(zoomedAbout([begin, end], wheelFactor ** (down * pixels), about, times.whole(), leastSteps * context.description.deltat));
    }
    event.preventDefault();
  }, { passive: false });
  return () => document.removeEventListener("scroll", onScroll, { capture: true });
}

/// A click, unless it becomes a double click or ends a drag, shows the time under it.
export function clickSeeks(chart: uPlot, context: Context, timeUnder: () => number): void {
  if (!context.description.history.possible) return;
  let waiting = 0;
  chart.over.addEventListener("click", (event) => {
    window.clearTimeout(waiting);
    const time = timeUnder();
    if (event.detail > 1 || event.ctrlKey || Number.isNaN(time)) return;
    waiting = window.setTimeout(() => void context.seeker.seek(time), doubleClickTime);
  });
}
