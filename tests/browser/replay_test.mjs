// A movie in the window: scrubbed, plotted and played.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { configs, eventually, openBrowser, openPage, read, resume, run, serve, time, widget, workFolder } from "./support.mjs";

const angle = "world.pendulum.arm.rod.angle";
const rate = "world.pendulum.arm.rod.rate";
let browser;
before(async () => { browser = await openBrowser(); });
after(() => browser?.close());

test("a movie is scrubbed to half of it, plotted and played", async (t) => {
  const folder = workFolder(t);
  const made = await run(["run", `${configs}/scenes/pendulum.hook`, "--for", "2 s", "--movie", "--out", "run"], folder);
  assert.equal(made.status, 0, made.complaints);
  const at = await run(["replay", "run/movie.h5", "--at", "1 s", "--json", "--record", `${angle},${rate}`], folder);
  assert.equal(at.status, 0, at.complaints);
  const numbers = [...at.out.matchAll(/-?\d+\.\d+(?:e[-+]?\d+)?/g)].map(([text]) => Number(text));

  const served = await serve(t, ["replay", "run/movie.h5", "--no-open"], folder);
  const page = await openPage(browser, served.url);
  t.after(() => page.context().close());
  const line = page.getByRole("slider", { name: "time line" });
  await line.fill("1");
  await eventually("half of it", async () => Math.abs((await time(page)) - 1) < 1e-9);
  for (const trail of [angle, rate]) {
    const value = await read(page, trail);
    assert.ok(numbers.includes(value), `${trail} is ${value} in the window; replay --at: ${at.out}`);
  }

  // Any variable: found among all values and plotted; the legend has its value at the last moment of the whole movie.
  if ((await page.getByRole("searchbox", { name: "search in all values" }).count()) === 0) await page.keyboard.press("t");
  await page.getByRole("tab", { name: "Values" }).click();
  await page.getByRole("searchbox", { name: "search in all values" }).fill(rate);
  await page.getByRole("button", { name: `plot ${rate}`, exact: true }).first().click();
  const plot = widget(page, `plot of ${rate}`);
  await eventually("it has points", async () => /\d/.test(await plot.locator(".plot-trace .number").textContent()));
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await plot.getByRole("button", { name: "copy as CSV" }).click();
  const rows = (await page.evaluate(() => navigator.clipboard.readText())).trim().split("\n").slice(1).map((row) => row.split(",").map(Number));
  assert.ok(rows.length > 100, `${rows.length} points`);
  assert.ok(Math.abs(rows[rows.length - 1][0] - 2) < 2e-3);
  // From rest at 90 degrees; the greatest speed is at the bottom, sqrt(2 g l).
  assert.ok(Math.abs(rows[0][1]) < 0.02);
  assert.ok(Math.abs(Math.max(...rows.map(([, value]) => Math.abs(value))) - Math.sqrt(2 * 9.81)) < 1e-3);

  await resume(page);
  await eventually("it plays", async () => (await time(page)) > 1.2);
  assert.deepEqual(page.problems, []);
});

test("a page with the movie inside plays without the program", async (t) => {
  const folder = workFolder(t);
  const made = await run(["run", `${configs}/scenes/pendulum.hook`, "--for", "1 s", "--movie", "--out", "run"], folder);
  assert.equal(made.status, 0, made.complaints);
  const written = await run(["replay", "run/movie.h5", "--html", "pendulum.html", "--fps", "50", "--record", `${angle},${rate}`], folder);
  assert.equal(written.status, 0, written.complaints);
  const at = await run(["replay", "run/movie.h5", "--at", "0.5 s", "--json", "--record", rate], folder);
  const [expected] = [...at.out.matchAll(/"[^"]*rate": (-?[0-9.e-]+)/g)].map(([, text]) => Number(text));

  const page = await openPage(browser, pathToFileURL(`${folder}/pendulum.html`).href);
  t.after(() => page.context().close());
  await eventually("it plays by itself", async () => (await time(page)) > 0.1);
  await page.getByRole("slider", { name: "time line" }).fill("0.5");
  await eventually("half of it", async () => Math.abs((await time(page)) - 0.5) < 1e-9);
  assert.equal(await read(page, rate), expected);
  await page.getByRole("combobox", { name: "speed" }).selectOption("5");
  await resume(page);
  await eventually("it begins again after its end", async () => (await time(page)) < 0.4);
  assert.deepEqual(page.problems, []);
});
