// Every scene that is shipped shows its bodies when it is opened, and still at its end: pixels that change when shapes are not drawn.
// HOOKPOINT_SCENES="scenes/pendulum.hook ...": those alone.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { ask, configs, eventually, experiment, openBrowser, openPage, program, serve, time, workFolder } from "./support.mjs";

const leastPixels = 300; // of a picture of some 400 000
const defaultDuration = 10; // [s] of a World that gives none
const asFastAsPossible = 0;
const mostWall = 60_000; // [ms] that a run may take to its end

const chosen = process.env.HOOKPOINT_SCENES?.split(" ");
const scenes = ["scenes", "paper", "views"].flatMap((folder) => readdirSync(join(configs, folder)).filter((name) => name.endsWith(".hook")).map((name) => `${folder}/${name}`))
  .filter((name) => chosen === undefined || chosen.includes(name));
const { engines } = JSON.parse(execFileSync(program, ["engines", "--json"]));
const found = (name) => engines.some((engine) => engine.name === name && engine.found);

let browser;
before(async () => { browser = await openBrowser(); });
after(() => browser?.close());

/// Pixels of the first camera that are other ones without its shapes, or what else a switch shows.
async function pixelsOf(page, what) {
  await page.evaluate(() => { document.querySelector(".camera details.menu").open = true; });
  const box = page.getByLabel(what, { exact: true }).first();
  const frames = () => page.evaluate(() => Number(document.querySelector("canvas[data-trail]").dataset.frames));
  const look = async (shown) => {
    const before = await frames();
    await box.setChecked(shown, { force: true });
    await eventually("another frame", async () => (await frames()) > before);
    await page.waitForTimeout(120); // what was under way is drawn
  };
  await look(false);
  await page.evaluate(() => {
    const canvas = document.querySelector("canvas[data-trail]");
    window.without = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
  });
  await look(true);
  return page.evaluate(() => {
    const canvas = document.querySelector("canvas[data-trail]");
    const withShapes = new Uint32Array(canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.buffer);
    const without = new Uint32Array(window.without.buffer);
    return withShapes.reduce((count, pixel, at) => count + Number(pixel !== without[at]), 0);
  });
}

/// Plays as fast as it can until it stands still, or has reached what a World without a duration takes.
async function playToEnd(page, url) {
  await ask(url, "speed", { factor: asFastAsPossible });
  await ask(url, "run").catch(() => {}); // one that has ended stays there
  let before = NaN, still = 0;
  for (const end = Date.now() + mostWall; Date.now() < end; ) {
    await page.waitForTimeout(200);
    const now = await time(page);
    still = now === before ? still + 1 : 0;
    if (still === 3 || now >= defaultDuration) break;
    before = now;
  }
  await ask(url, "pause");
}

/// A block without friction at 30 m/s, on ground that is drawn by tiles for 5 m around it.
const fast = (duration) => `
World lab {
  gravity = 9.81; deltat = 1 ms; duration = ${duration} s;
  Material ice { normal_stiffness = 20000; normal_damping = 200; tangential_stiffness = 20000; tangential_damping = 200; static_friction = 0; kinetic_friction = 0; }
  Terrain.Flat ground { material = ice; }
  Robot block { Base.mobile { rest_on = ground; velocity = 30, 0, 0; Shape.Box { dimensions = 0.2,0.2,0.1; mass = 1; } } }
}`;

test("ground goes on under what has left its tiles, and the picture with it", async (t) => {
  const folder = workFolder(t);
  const server = await serve(t, ["view", experiment(folder, "fast.hook", fast(5)), "--no-open"], folder);
  const page = await openPage(browser, server.url);
  t.after(() => page.context().close());
  await ask(server.url, "speed", { factor: asFastAsPossible });
  await eventually("the end", async () => (await time(page)) === 5, mostWall);
  await ask(server.url, "pause");
  assert.ok((await pixelsOf(page, "shapes")) > leastPixels);
  const [ground, all] = [await pixelsOf(page, "terrain"), await page.evaluate(() => {
    const { width, height } = document.querySelector("canvas[data-trail]");
    return width * height;
  })];
  assert.ok(ground > 0.4 * all, `${ground} of ${all} pixels`);
  assert.deepEqual(page.problems, []);
});

test("playing holds at the file's duration, goes on when it is told to, or begins again", async (t) => {
  const folder = workFolder(t);
  const server = await serve(t, ["view", experiment(folder, "fast.hook", fast(0.3)), "--no-open"], folder);
  const page = await openPage(browser, server.url);
  t.after(() => page.context().close());
  await eventually("the end", async () => (await time(page)) === 0.3);
  await page.waitForTimeout(500);
  assert.equal(await time(page), 0.3);
  await page.getByRole("button", { name: "run (Space)" }).click();
  await eventually("beyond", async () => (await time(page)) > 0.4);
  await page.getByRole("combobox", { name: "at the end" }).selectOption("again");
  await ask(server.url, "reset");
  for (let round = 0; round < 2; ++round) {
    await eventually("the end", async () => (await time(page)) === 0.3);
    await eventually("a beginning", async () => (await time(page)) < 0.3);
  }
  assert.deepEqual(page.problems, []);
});

for (const scene of scenes) {
  const text = readFileSync(join(configs, scene), "utf8");
  const engine = /\bengine = (\w+);/.exec(text)?.[1];
  const missing = engine !== undefined && engine !== "dts" && !found(engine);
  test(`${scene} shows its bodies`, { skip: missing && `engine ${engine} is not found` }, async (t) => {
    const server = await serve(t, ["view", join(configs, scene), "--no-open"], workFolder(t));
    const page = await openPage(browser, server.url);
    t.after(() => page.context().close());
    await ask(server.url, "pause");
    const [first, at] = [await pixelsOf(page, "shapes"), await time(page)];
    await playToEnd(page, server.url);
    const [last, end] = [await pixelsOf(page, "shapes"), await time(page)];
    t.diagnostic(`${first} pixels at ${at} s, ${last} at ${end} s`);
    assert.ok(first >= leastPixels && last >= leastPixels, `${first} pixels at ${at} s, ${last} at ${end} s`);
    assert.deepEqual(page.problems, []);
  });
}
