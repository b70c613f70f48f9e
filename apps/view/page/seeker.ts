// Goes to a time of the run: one request at a time, the newest wish next.
import type { Connection } from "./connection.ts";

export class Seeker {
  private wanted: number | null = null;
  private running = false;

  constructor(private readonly connection: () => Pick<Connection, "request">, private readonly problem: (text: string) => void) {}

  get busy(): boolean {
    return this.running;
  }

  readonly seek = async (time: number): Promise<void> => {
    this.wanted = time;
    if (this.running) return;
    this.running = true;
    try {
      while (this.wanted !== null) {
        const next: number = this.wanted;
        this.wanted = null;
        await this.connection().request("seek", { time: next });
      }
    } catch (refused) {
      this.wanted = null;
      this.problem((refused as Error).message);
    } finally {
      this.running = false;
    }
  };
}
