// A page that was opened with ?picture=NAME, by a program and not by a person: the scene at time 0,
// sent back once it is drawn.
import type { Context } from "./context.ts";
import { base64Of } from "./transport.ts";

export async function answerPictureRequest(context: Context): Promise<void> {
  const name = new URLSearchParams(location.search).get("picture");
  if (name === null) return;
  await context.connection.request("pause", {});
  await context.connection.request("reset", {});
  await atStart(context);
  const take = [...context.pictures.values()][0];
  if (take === undefined) throw new Error("there is no camera to take a picture of");
  await context.connection.request("picture", { name, png: await base64Of(await take()) });
}

/// Until the scene at time 0 has been shown, and drawn: two frames of the screen later.
function atStart(context: Context): Promise<void> {
  return new Promise((resolve) => {
    const forget = context.onSnapshot((snapshot) => {
      if (snapshot.time !== 0) return;
      forget();
      requestAnimationFrame(() => requestAnimationFrame(() => resolve()));
    });
  });
}
