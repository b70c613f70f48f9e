// What the window shows is so, and what it offers it does: after the end, in the past, in a replay, when a mistake is repaired.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { block, configs, eventually, experiment, openBrowser, openPage, pause, read, run, serve, time, widget, workFolder } from "./support.mjs";

let browser;
before(async () => { browser = await openBrowser(); });
after(() => browser?.close());

async function open(t, text, words = []) {
  const folder = workFolder(t);
  const file = experiment(folder, "block.hook", text);
  const served = await serve(t, ["view", file, "--no-open", ...words], folder);
  const page = await openPage(browser, served.url);
  t.after(() => page.context().close());
  return { page, folder, served };
}
const runButton = (page, name) => page.getByRole("button", { name: `${name} (Space)` });

test("back in the past a plot that rolls ends at the moment shown, and its numbers are of it", async (t) => {
  // z = z0 - g t^2 / 2 while it falls.
  const falling = block(20_000, 'Plot height { show = lab.block.position.z; window = 0.2 s; }').replace("rest_on = ground;", "location = 0, 0, 50;");
  const { page } = await open(t, falling);
  await eventually("time passes", async () => (await time(page)) > 1);
  await pause(page);
  await page.getByRole("slider", { name: "history" }).fill("0.5");
  await eventually("the past", async () => Math.abs((await time(page)) - 0.5) < 2e-3);
  const plot = widget(page, "Window.height").or(widget(page, "height")).first();
  await eventually("the instant", async () => (await plot.locator(".plot-at").textContent()).startsWith("0.50000"));
  const shown = Number((await plot.locator(".plot-trace .number").first().textContent()).replace("\u2212", "-"));
  assert.ok(Math.abs(shown - (50 - 9.81 * 0.125)) < 0.01, `${shown}`);
  assert.deepEqual(page.problems, []);
});

test("after its end a run offers to begin again, and does", async (t) => {
  const { page } = await open(t, block(), ["--for", "0.3 s"]);
  await runButton(page, "begin again").waitFor();
  await page.getByRole("slider", { name: "history" }).fill("0.1");
  await eventually("the past", async () => Math.abs((await time(page)) - 0.1) < 2e-3);
  assert.equal(await runButton(page, "go on from here").count(), 0);
  await runButton(page, "begin again").click();
  await eventually("it runs", async () => { const now = await time(page); return now > 0 && now < 0.3; });
  assert.equal(await page.locator(".notice.error").count(), 0);
});

test("Space lets go of what the file's own button holds", async (t) => {
  const { page } = await open(t, block(20_000, "Button.Light pause Wire TO lab.running;"));
  await eventually("time passes", async () => (await time(page)) > 0.1);
  await page.getByRole("button", { name: "pause", exact: true }).click();
  await eventually("it is paused", async () => (await read(page, "lab.running")) === 0);
  await runButton(page, "run").waitFor(); // the page knows it
  const stood = await time(page);
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press("Space");
  await eventually("time passes again", async () => (await time(page)) > stood);
  assert.deepEqual(await page.locator(".notice.error .said").allTextContents(), []);
});

test("what was wrong with a file is told where it stands, and no more once it is repaired", async (t) => {
  const { page, folder } = await open(t, block());
  experiment(folder, "block.hook", block().replace("mass = 1;", "mass = 1 s;"));
  const said = page.locator(".notice.error .said").first();
  await said.waitFor();
  assert.match(await said.evaluate((each) => getComputedStyle(each).fontFamily), /mono/i);
  assert.match(await said.evaluate((each) => getComputedStyle(each).whiteSpace), /pre/);
  experiment(folder, "block.hook", block().replace("mass = 1;", "mass = 2;"));
  await eventually("nothing is wrong", async () => (await page.locator(".notice.error").count()) === 0);
});

test("after quit the page says that the program has ended", async (t) => {
  const { page, served } = await open(t, block(20_000, "Button quit Wire TO Simulator.quit;"));
  await page.getByRole("button", { name: "quit" }).click();
  assert.equal(await served.ended, 0);
  await eventually("it is told", async () => /^the program has ended: Simulator.quit/.test(await page.locator(".lost").textContent()));
});

test("a click into the picture leaves the arrow key to the run", async (t) => {
  const { page } = await open(t, block());
  await pause(page);
  await page.locator("canvas[data-trail]").click({ position: { x: 20, y: 20 } });
  const [before, turn] = [await time(page), await read(page, "camera.euler1")];
  await page.keyboard.press("ArrowRight");
  await eventually("one step", async () => Math.abs((await time(page)) - before - 1e-3) < 1e-9);
  assert.equal(await read(page, "camera.euler1"), turn);
});

test("what is of the page stands behind what is of the experiment", async (t) => {
  const { page } = await open(t, block());
  if ((await page.getByRole("searchbox", { name: "search in all values" }).count()) === 0) await page.keyboard.press("t");
  await page.locator(".tree summary").first().waitFor();
  const names = await page.locator(".tree > details > summary").allTextContents();
  assert.equal(names.at(-1), "windows and subjects");
  assert.ok(names.includes("lab") && !names.some((name) => /^(Window|Subjects)/.test(name)), names.join(", "));
});

test("two fingers apart bring the camera nearer, and do not turn it", async (t) => {
  const { page } = await open(t, block());
  await pause(page);
  const canvas = page.locator("canvas[data-trail]");
  const [turn, distance] = [await read(page, "camera.euler1"), await read(page, "camera.distance")];
  await canvas.evaluate((element) => {
    element.setPointerCapture = () => {};
    const send = (type, pointerId, x) => {
      const { left, top } = element.getBoundingClientRect();
      element.dispatchEvent(new PointerEvent(type, { pointerId, pointerType: "touch", clientX: left + x, clientY: top + 100, button: 0, bubbles: true }));
    };
    send("pointerdown", 11, 100);
    send("pointerdown", 12, 150);
    for (let x = 150; x <= 200; x += 10) send("pointermove", 12, x);
    send("pointerup", 12, 200);
    send("pointerup", 11, 100);
  });
  await eventually("half as far", async () => Math.abs((await read(page, "camera.distance")) - distance / 2) < 1e-6 * distance);
  assert.equal(await read(page, "camera.euler1"), turn);
});

test("in a replay nothing is moved that cannot be moved", async (t) => {
  const folder = workFolder(t);
  const file = experiment(folder, "block.hook", block(20_000, "Valuator.Slider far { range = 0.5, 5; Wire TO camera.distance; }").replace("deltat = 1 ms;", "deltat = 1 ms; duration = 0.3 s;"));
  const made = await run(["run", file, "--movie", "--out", "film"], folder);
  assert.equal(made.status, 0, made.complaints);
  const { url } = await serve(t, ["replay", "film/movie.h5", "--no-open"], folder);
  const page = await openPage(browser, url);
  t.after(() => page.context().close());
  const slider = page.getByRole("slider", { name: "far" });
  await eventually("it has its value", async () => Math.abs(Number(await slider.inputValue()) - 1) < 0.05);
  assert.ok(await slider.isDisabled());
  // A drag with control on the block turns the camera or does nothing; it does not pull.
  const box = await page.locator("canvas[data-trail]").boundingBox();
  const picture = () => page.locator("canvas[data-trail]").evaluate((canvas) => canvas.toDataURL());
  const before = await picture();
  await page.keyboard.down("Control");
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 60, box.y + box.height / 2 - 30, { steps: 4 });
  await page.waitForTimeout(200);
  assert.equal(await picture(), before);
  await page.mouse.up();
  await page.keyboard.up("Control");
});

test("a file without windows has plots of its robot from the beginning on, and what is set by sliders", async (t) => {
  const served = await serve(t, ["view", `${configs}/scenes/double_pendulum.hook`, "--no-open"], workFolder(t));
  const page = await openPage(browser, served.url, { viewport: { width: 1200, height: 800 } });
  t.after(() => page.context().close());
  await page.getByRole("tab", { name: "Overview", selected: true }).waitFor();
  const energy = page.getByRole("figure", { name: "Energy" });
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await eventually("time passes", async () => (await time(page)) > 1);
  await pause(page);
  await page.waitForTimeout(500);
  await energy.getByRole("button", { name: "copy as CSV" }).click();
  const rows = (await page.evaluate(() => navigator.clipboard.readText())).trim().split("\n").slice(1).map((row) => row.split(",").map(Number));
  assert.equal(rows[0][0], 0);
  // Nothing drives it and nothing rubs: the sum stays.
  const sums = rows.map(([, kinetic, potential]) => kinetic + potential);
  const most = Math.max(...rows.map(([, kinetic]) => kinetic));
  assert.ok(Math.max(...sums) - Math.min(...sums) < 1e-3 * most, `${Math.min(...sums)} to ${Math.max(...sums)}`);
  const drive = page.getByRole("slider", { name: "pendulum.arm.upper.torque" });
  await drive.fill("5");
  await eventually("it is set", async () => (await read(page, "world.pendulum.arm.upper.torque")) === 5);
  assert.deepEqual(page.problems, []);
});

/// A block that falls for 2 s, and two plots of it.
const falling = block(20_000, `
  Plot height { show = lab.block.position.z; }
  Plot speed { range = -200, 20; window = 0.5 s; Trace { y = lab.block.velocity.z; label = "down"; } Trace { y = lab.block.velocity.x; label = "across"; } }
`).replace("rest_on = ground;", "location = 0, 0, 5000;");
const plotOf = (page, name) => page.getByRole("figure", { name, exact: true });
const timeRead = async (plot) => Number((await plot.locator(".plot-at").textContent()).replace(" s", ""));
/// Brings the pointer to a part of a plot's width.
async function pointAt(page, plot, part) {
  const box = await plot.locator(".u-over").boundingBox();
  await page.mouse.move(box.x + part * box.width, box.y + box.height / 2);
}
/// The times at the left and right edges of a plot.
async function stretchOf(page, plot) {
  const edges = [];
  for (const part of [0.002, 0.998]) {
    await pointAt(page, plot, part);
    edges.push(await timeRead(plot));
  }
  return edges;
}
async function openFalling(t) {
  const { page } = await open(t, falling, ["--for", "2 s"]);
  await page.setViewportSize({ width: 1000, height: 900 });
  await runButton(page, "begin again").waitFor({ timeout: 120_000 });
  await eventually("the plots have all of it", async () => Math.abs((await timeRead(plotOf(page, "height"))) - 2) < 2e-3);
  return page;
}

test("plots share the time under the pointer and the stretch that they show", async (t) => {
  const page = await openFalling(t);
  const [height, speed] = [plotOf(page, "height"), plotOf(page, "speed")];
  await pointAt(page, height, 0.25);
  const read = await timeRead(height);
  assert.ok(read > 0.3, `${read}`);
  assert.equal(await timeRead(speed), read);
  const down = Number((await speed.locator(".plot-trace .number").first().textContent()).replace("\u2212", "-"));
  assert.ok(Math.abs(down + 9.81 * read) < 0.02, `${down} m/s at ${read} s`);

  const [first, last] = await stretchOf(page, height);
  await pointAt(page, height, 0.25);
  await page.mouse.wheel(0, -500);
  await eventually("the wheel has zoomed", async () => { const [begin, end] = await stretchOf(page, height); return end - begin < 0.6 * (last - first); });
  await pointAt(page, height, 0.25);
  assert.ok(Math.abs((await timeRead(height)) - read) < 0.02, "what is under the pointer stays there");
  const [one, other] = [await stretchOf(page, height), await stretchOf(page, speed)];
  one.forEach((edge, i) => assert.ok(Math.abs(edge - other[i]) < 0.02, `${one} and ${other}`));
  await height.locator(".u-over").dblclick();
  await eventually("all is shown again, of the other plot what its file says", async () => {
    const [[begin, end], [from, to]] = [await stretchOf(page, height), await stretchOf(page, speed)];
    return Math.abs(begin - first) < 0.02 && Math.abs(end - last) < 0.02 && Math.abs(to - from - 0.5) < 0.02;
  });
  assert.ok((await time(page)) > 1.99, "a double click goes nowhere");
  assert.deepEqual(page.problems, []);
});

test("a click in a plot goes to that time", async (t) => {
  const page = await openFalling(t);
  const height = plotOf(page, "height");
  await pointAt(page, height, 0.5);
  const wanted = await timeRead(height);
  const box = await height.locator(".u-over").boundingBox();
  await page.mouse.click(box.x + 0.5 * box.width, box.y + box.height / 2);
  await eventually("it is there", async () => Math.abs((await time(page)) - wanted) < 3e-3);
  assert.deepEqual(page.problems, []);
});

test("an entry of the legend hides its line", async (t) => {
  const page = await openFalling(t);
  const speed = plotOf(page, "speed");
  const down = speed.getByRole("button", { name: "down" });
  const blue = () => speed.locator(".u-wrap canvas").evaluate((canvas) => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let count = 0;
    for (let at = 0; at < data.length; at += 4) if (data[at] < 40 && Math.abs(data[at + 1] - 114) < 30 && Math.abs(data[at + 2] - 178) < 30 && data[at + 3] > 200) ++count;
    return count;
  });
  await eventually("the line is there", async () => (await blue()) > 50);
  await down.click();
  assert.equal(await down.getAttribute("aria-pressed"), "false");
  await eventually("the line is hidden", async () => (await blue()) === 0);
  await down.click();
  await eventually("the line is back", async () => (await blue()) > 50);
});

test("the bar marks what was changed and what touched", async (t) => {
  // It falls 20 m in 2 s: the page marks what it sees, and a busy browser may miss the first second.
  const { page } = await open(t, block().replace("rest_on = ground;", "location = 0, 0, 20.05;"));
  const marks = page.getByRole("img", { name: /^events: / });
  await eventually("it has come to the ground", async () => /\b1 contact/.test(await marks.getAttribute("aria-label")));
  await page.evaluate(() => window.hookpoint.set("lab.push.force.x", 0.5));
  await eventually("the change is marked", async () => /\b1 change\b/.test(await marks.getAttribute("aria-label")));
  const drawn = await marks.evaluate((canvas) => canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.some((each) => each > 0));
  assert.ok(drawn);
  await page.reload();
  await eventually("a page that is opened later knows it", async () => /\b1 change\b/.test(await page.getByRole("img", { name: /^events: / }).getAttribute("aria-label")));
});

test("two units have an axis each, three have a panel each, which share the time", async (t) => {
  const { page } = await open(t, block(20_000, `
    Plot two { Trace { y = lab.block.position.z; } Trace { y = lab.block.velocity.z; } }
    Plot three { show = lab.block.position.z, lab.block.velocity.z, lab.block.kinetic_energy; }
  `).replace("rest_on = ground;", "location = 0, 0, 5000;"));
  await eventually("time passes", async () => (await time(page)) > 0.5);
  assert.equal(await plotOf(page, "two").locator(".u-axis").count(), 3);
  const three = page.getByRole("group", { name: "three", exact: true });
  assert.deepEqual(await three.getByRole("figure").evaluateAll((each) => each.map((figure) => figure.getAttribute("aria-label"))), ["three [m]", "three [m/s]", "three [J]"]);
  await pause(page);
  await pointAt(page, plotOf(page, "two"), 0.5);
  const read = await timeRead(plotOf(page, "two"));
  assert.equal(await timeRead(plotOf(page, "three [J]")), read);
  assert.deepEqual(page.problems, []);
});
