// Brings a plot what the program has recorded: all of it at first, then a few times a second what is new.
import type { Context } from "./context.ts";
import { Series } from "./series.ts";

const period = 200; // ms
const pointsAtOnce = 4000;

export class TraceFeed {
  readonly series: Series;
  private asking = false;
  private branch = Infinity; // of an answer under way, what lies after this is of another past
  private readonly timer: ReturnType<typeof setInterval>;
  private readonly forget: () => void;

  constructor(private readonly context: Context, private readonly trails: string[], private readonly changed: () => void) {
    this.series = new Series(trails.length);
    this.timer = setInterval(() => void this.ask(), period);
    this.forget = context.onBranch((time) => {
      this.branch = Math.min(this.branch, time);
      this.series.cutAfter(time);
      this.changed();
    });
    void this.ask();
  }

  dispose(): void {
    clearInterval(this.timer);
    this.forget();
  }

  private async ask(): Promise<void> {
    const latest = this.context.latest;
    if (this.asking || latest === null || document.hidden || this.trails.length === 0 || !this.context.connection.connected) return;
    const to = latest.past ? latest.historyLast : latest.time;
    const from = this.series.length === 0 ? 0 : this.series.last + this.context.description.deltat / 2;
    if (to < from) return;
    this.asking = true;
    this.branch = Infinity;
    try {
      const trace = await this.context.connection.request("trace", { trails: this.trails, from, to, points: pointsAtOnce });
      this.series.append(trace.times, trace.values);
      if (this.branch !== Infinity) this.series.cutAfter(this.branch);
      if (trace.times.length > 0) this.changed();
    } catch (refused) {
      // A refusal would come again each time; a line that was lost comes back.
      if (this.context.connection.connected) {
        clearInterval(this.timer);
        this.context.notice("warning", (refused as Error).message);
      }
    } finally {
      this.asking = false;
    }
  }
}
