// The pictures of the manual's gallery and one of a study: run.sh BUILD_FOLDER gallery.mjs FOLDER [NAME...]. A run is begun anew, paused, and stepped to
// the moment of its picture, so that a picture is made of the same numbers every time.
import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { argv } from "node:process";
import { fileURLToPath } from "node:url";
import { PNG } from "pngjs";
import { configs, eventually, openBrowser, openPage, serve, time, workFolder } from "./support.mjs";

export const width = 1280, cameraWidth = 1276, leastHeight = 500, mostHeight = 1800;

/// `set`: what is moved at the beginning; `time`: of the picture [s]; `deltat`: of the file [s];
/// `needs`: engines; `quality`: of the picture, else low; `windows`: those of the file alone, without the panel of subjects; `camera`:
/// what the file's camera shows alone, 638 pixels of the page wide, of two of the picture each.
export const pictures = {
  window_hexapod: { file: "paper/fig1a_hexapod.hook", time: 3, deltat: 0.0004 },
  window_arm: {
    file: "paper/fig7_two_joint_arm.hook", time: 1.5, deltat: 0.001,
    set: {
      "zoom_factor.value": 1.3, "controllers.goal_angle.value": 0.8, "controllers.pconstant.value": 2000, "controllers.dconstant.value": 400,
      "controllers.goal_angle#2.value": 0.6, "controllers.pconstant#2.value": 400, "controllers.dconstant#2.value": 20,
    },
  },
  window_creep: { file: "views/creep_side_by_side.hook", time: 10, deltat: 0.001, needs: ["mujoco"] },
  real_impacts_window: {
    file: "views/thrown_cube.hook", time: 0.23, deltat: 0.0005, needs: ["ode", "bullet", "mujoco", "dart", "simbody"], quality: "high", windows: true,
  },
  shapes_stairs: { file: "scenes/stairs_hexapod.hook", time: 7, deltat: 0.0002, quality: "high", camera: true },
  shapes_sole: { file: "scenes/sole_over_edge.hook", time: 0.15, deltat: 0.0001, quality: "high", camera: true },
  shapes_rolling: { file: "scenes/rolling_wheel.hook", time: 0.9, deltat: 0.0001, quality: "high", camera: true },
  shapes_pile: { file: "scenes/box_pile.hook", time: 1, deltat: 0.0002, quality: "high", camera: true },
  shapes_pushed: { file: "scenes/pushed_ball.hook", time: 1.5, deltat: 0.0001, quality: "high", camera: true },
  window_study: { file: "studies/creep.hook", study: true },
};

/// One picture as the bytes of a PNG; `test` is told what to end afterwards.
export async function takePicture(test, browser, name) {
  const picture = pictures[name];
  const folder = workFolder(test);
  const options = { viewport: { width, height: leastHeight }, colorScheme: "light", deviceScaleFactor: picture.camera ? 2 : 1 };
  const file = join(configs, picture.file);
  const page = picture.study ? await openStudy(test, browser, file, folder, options) : await openRun(test, browser, file, folder, options, picture);
  const bytes = await still(page, picture.camera ? () => cameraPicture(page) : () => page.screenshot());
  assert.deepEqual(page.problems, []);
  return packed(bytes);
}

/// The same pixels in fewer bytes: a browser's encoder is fast, and leaves lines that end in haze at twice the size.
function packed(bytes) {
  const rgb = 2, noFilter = 0, defaultStrategy = 0;
  return PNG.sync.write(PNG.sync.read(bytes), { colorType: rgb, filterType: noFilter, deflateLevel: 9, deflateStrategy: defaultStrategy });
}

async function openRun(test, browser, file, folder, options, picture) {
  const { url } = await serve(test, ["view", file, "--no-open"], folder);
  const page = await openPage(browser, url, options);
  test.after(() => page.context().close());
  const steps = Math.round(picture.time / picture.deltat);
  await ask(page, [["pause", {}], ["reset", {}],
    ...(picture.set === undefined ? [] : [["set", { values: picture.set }]]), ["step", { count: steps }]]);
  const reached = await time(page);
  assert.ok(Math.abs(reached - picture.time) < picture.deltat / 2, `it stopped at ${reached} s`);
  if (picture.quality !== undefined) await page.getByRole("combobox", { name: "quality of the picture" }).selectOption(picture.quality);
  if (picture.camera) await page.addStyleTag({ content: ".window .camera { flex: none !important; width: 640px; }" });
  if (picture.windows) await fit(page, "main > .window:not(.creep)", 6);
  else await fit(page);
  return page;
}

/// As high as what is in the page, within reason.
async function fit(page, parts = "main > *", below = 12) {
  const bottom = await page.evaluate((all) => Math.max(...[...document.querySelectorAll(all)].map((each) => each.getBoundingClientRect().bottom)), parts);
  await page.setViewportSize({ width, height: Math.min(Math.max(Math.ceil(bottom) + below, leastHeight), mostHeight) });
}

/// A study that is on its way: half of its rows are there, and it is held.
async function openStudy(test, browser, file, folder, options) {
  const { url, child } = await serve(test, ["study", file, "--quick", "--jobs", "1", "--view", "--no-open"], folder);
  const context = await browser.newContext(options);
  test.after(() => context.close());
  const page = await context.newPage();
  page.problems = [];
  page.on("pageerror", (error) => page.problems.push(String(error)));
  await page.goto(url);
  const bar = page.locator("progress").first();
  await eventually("half of the rows", async () => (await bar.count()) > 0 && (await bar.evaluate((each) => each.value / each.max)) >= 0.5, 300_000);
  child.kill("SIGSTOP");
  await fit(page);
  return page;
}

/// Requests of a client of its own, in the page, one after the other (docs/view_protocol.md).
async function ask(page, requests) {
  await page.evaluate(async (all) => {
    const socket = new WebSocket(`${location.origin.replace("http", "ws")}/socket${location.search}`);
    await new Promise((resolve, reject) => {
      socket.onopen = resolve;
      socket.onerror = () => reject(new Error("no socket"));
    });
    for (const [id, [what, members]] of all.entries()) {
      await new Promise((resolve, reject) => {
        socket.onmessage = ({ data }) => {
          if (typeof data !== "string") return;
          const answer = JSON.parse(data);
          if (answer.id !== id) return;
          if (answer.ok) resolve();
          else reject(new Error(`${what}: ${answer.error}`));
        };
        socket.send(JSON.stringify({ id, do: what, ...members }));
      });
    }
    socket.close();
  }, requests);
}

/// What its only camera shows.
async function cameraPicture(page) {
  const address = await page.locator("canvas[data-trail]").evaluate((canvas) => canvas.toDataURL("image/png"));
  return Buffer.from(address.slice(address.indexOf(",") + 1), "base64");
}

/// What `take` gives once it stands still, or after ten seconds as it is.
async function still(page, take) {
  let before = await take();
  for (const end = Date.now() + 10_000; Date.now() < end; ) {
    await page.waitForTimeout(400);
    const now = await take();
    if (now.equals(before)) return now;
    before = now;
  }
  return before;
}

async function main([folder, ...names]) {
  const unknown = names.filter((name) => !(name in pictures));
  assert.deepEqual(unknown, [], `there are: ${Object.keys(pictures).join(", ")}`);
  mkdirSync(folder, { recursive: true });
  const browser = await openBrowser();
  const ends = [];
  try {
    for (const name of names.length > 0 ? names : Object.keys(pictures)) {
      const bytes = await takePicture({ after: (end) => ends.push(end) }, browser, name);
      writeFileSync(join(folder, `${name}.png`), bytes);
      console.log(`${name}.png: ${Math.ceil(bytes.length / 1000)} kB`);
      for (const end of ends.splice(0).reverse()) await end();
    }
  } finally {
    for (const end of ends.reverse()) await end();
    await browser.close();
  }
}

if (argv[1] === fileURLToPath(import.meta.url)) await main(argv.slice(2));
