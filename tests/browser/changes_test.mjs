// What people did to a run is repeated by `run --changes` byte for byte, and looking on changes nothing.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { block, bytesOf, eventually, experiment, openBrowser, openPage, pause, read, resume, run, serve, time, widget, workFolder } from "./support.mjs";

const trails = "lab.block.position,lab.block.velocity,lab.block.contact.force,lab.push.force,Simulator.pull.force";
const text = block(20_000, "Valuator.Slider across { range = -5 N, 5 N; Wire TO lab.push.force.y; }");
let browser;
before(async () => { browser = await openBrowser(); });
after(() => browser?.close());

const lastTime = (file) => readFileSync(file, "utf8").trim().split("\n").pop().split(",")[0];

test("sliders, a pull, an edit and a way back are repeated byte for byte", async (t) => {
  const folder = workFolder(t);
  const file = experiment(folder, "block.hook", text);
  const served = await serve(t, ["view", file, "--no-open", "--record", trails, "--movie", "--out", "watched", "--for", "600 s"], folder);
  const page = await openPage(browser, served.url);
  t.after(() => page.context().close());
  const across = page.getByRole("slider", { name: "across" });
  await across.fill("2");
  await eventually("it is pushed", async () => (await read(page, "lab.push.force.y")) === 2);
  await across.fill("-4.25");

  const box = await widget(page, "camera").boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.keyboard.down("Control");
  await page.mouse.down();
  await page.mouse.move(x + 100, y - 40, { steps: 4 });
  await eventually("it is pulled", async () => (await read(page, "Simulator.pull.force.z")) !== 0);
  await page.mouse.up();
  await page.keyboard.up("Control");
  await eventually("it is let go", async () => (await read(page, "Simulator.pull.body")) === -1);

  // Back to between the pull and one more change, and on: what lies after that moment is given up, in the files too.
  const pulled = await time(page);
  await eventually("a while after", async () => (await time(page)) > pulled + 0.2);
  await across.fill("1");
  await eventually("it is pushed once more", async () => (await read(page, "lab.push.force.y")) === 1);
  await pause(page);
  const back = Number((pulled + 0.1).toFixed(3));
  await page.getByRole("slider", { name: "history" }).fill(String(back));
  await eventually("the past", async () => Math.abs((await time(page)) - back) < 2e-3);
  await resume(page);
  await eventually("on from there", async () => (await time(page)) > back + 0.1);
  await across.fill("3");
  await eventually("it is pushed again", async () => (await read(page, "lab.push.force.y")) === 3);
  const then = await time(page);
  await eventually("some way", async () => (await time(page)) > then + 0.3);
  assert.deepEqual(page.problems, []);
  assert.equal(await served.interrupt(), 0, served.complaints());

  const changes = readFileSync(`${folder}/watched/changes.csv`, "utf8");
  assert.match(changes, /lab\.push\.force\.y|across/);
  assert.match(changes, /Simulator\.pull\.body/);
  assert.doesNotMatch(changes, /across\.value,1\n/);
  const reached = lastTime(`${folder}/watched/trace.csv`);
  const again = await run(["run", file, "--changes", "watched/changes.csv", "--record", trails, "--movie", "--out", "again", "--for", `${reached} s`], folder);
  assert.equal(again.status, 0, again.complaints);
  assert.equal(lastTime(`${folder}/again/trace.csv`), reached);
  for (const name of ["trace.csv", "changes.csv"])
    assert.ok(bytesOf(folder, "watched", name).equals(bytesOf(folder, "again", name)), `${name} differs`);
  // The movies hold the experiment too, whose duration is another; all that they know of a moment is the same.
  for (const moment of [back, back + 0.05, Number(reached)]) {
    const [first, second] = await Promise.all(["watched", "again"].map((name) => run(["replay", `${name}/movie.h5`, "--at", `${moment} s`, "--json"], folder)));
    assert.equal(first.status, 0, first.complaints);
    const known = (told) => told.out.split("\n").filter((line) => !line.includes("lab.duration"));
    assert.ok(known(first).length > 50);
    assert.deepEqual(known(first), known(second), `at ${moment} s`);
  }
});

test("watched or not, a run leaves the same bytes", async (t) => {
  const folder = workFolder(t);
  const file = experiment(folder, "block.hook", text.replace("rest_on = ground;", "location = 0, 0, 0.3; orientation = 20 deg, 30 deg, 0; velocity = 1, 0.3, 0;"));
  const words = ["--record", trails, "--movie", "--for", "1 s"];
  const served = await serve(t, ["view", file, "--no-open", "--out", "watched", ...words], folder);
  const page = await openPage(browser, served.url);
  t.after(() => page.context().close());
  await eventually("it has ended", async () => (await page.locator(".transport .state").first().textContent()) === "ended", 30_000);
  // Once the program is gone the page looks for it in vain.
  assert.deepEqual(page.problems, []);
  assert.equal(await served.interrupt(), 0, served.complaints());
  assert.equal((await run(["run", file, "--out", "plain", ...words], folder)).status, 0);
  assert.equal(existsSync(`${folder}/watched/changes.csv`), false);
  for (const name of ["trace.csv", "movie.h5"])
    assert.ok(bytesOf(folder, "watched", name).equals(bytesOf(folder, "plain", name)), `${name} differs`);
});
