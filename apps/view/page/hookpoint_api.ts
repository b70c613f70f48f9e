// What scripts and tests may do with the page: window.hookpoint.
import type { Connection } from "./connection.ts";
import type { Context } from "./context.ts";

export interface HookpointApi {
  /// The current value of a trail with its unit.
  read(trail: string): Promise<{ value: number; unit: string }>;
  /// The simulation's time [s]; studies have none.
  time(): Promise<number | undefined>;
  /// Sets a port; rejects with what the program says where it refuses.
  set(trail: string, value: number): Promise<void>;
}

declare global {
  interface Window {
    hookpoint: HookpointApi;
  }
}

export function offerApi(connection: Connection, context: () => Context | null, showsStudies: () => boolean): void {
  const read = async (trail: string) => {
    const { values } = await connection.request("read", { trails: [trail] });
    return { value: values[0].value ?? NaN, unit: values[0].unit };
  };
  window.hookpoint = {
    read,
    set: async (trail, value) => {
      await connection.request("set", { values: { [trail]: value } });
    },
    time: async () => {
      if (showsStudies()) return undefined;
      const now = context();
      if (now === null) throw new Error("the program has not described its run yet");
      return (await read(`${now.description.world}.time`)).value;
    },
  };
}
