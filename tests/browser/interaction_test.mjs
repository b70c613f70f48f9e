// What a person does to a run: pulls a body, stops and steps time, goes back and on, edits, saves a file.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { asFastAsPossible, block, eventually, experiment, openBrowser, openPage, pause, read, resume, run, serve, speed, time, widget, workFolder, standing, unchanging } from "./support.mjs";

let browser;
before(async () => { browser = await openBrowser(); });
after(() => browser?.close());

async function open(test, text) {
  const folder = workFolder(test);
  const file = experiment(folder, "block.hook", text);
  const served = await serve(test, ["view", file, "--no-open"], folder);
  const page = await openPage(browser, served.url);
  test.after(() => page.context().close());
  return { folder, file, served, page };
}
const position = async (page) => [await read(page, "lab.block.position.x"), await read(page, "lab.block.position.y"), await read(page, "lab.block.position.z")];
const distance = (a, b) => Math.hypot(...a.map((each, i) => each - b[i]));
async function editField(page, trail, value) {
  const parameters = page.getByRole("tab", { name: "Parameters" });
  if ((await parameters.count()) === 0) await page.keyboard.press("t");
  await parameters.click();
  await page.getByRole("searchbox", { name: "search in all parameters" }).fill(trail);
  const field = page.getByRole("textbox", { name: trail, exact: true });
  await field.fill(value);
  await field.press("Enter");
}

test("dragging with control pulls a body, and lets it go", async (t) => {
  const { page } = await open(t, block());
  const start = await position(page);
  const box = await widget(page, "camera").boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.keyboard.down("Control");
  await page.mouse.down();
  await page.mouse.move(x + 60, y - 10, { steps: 3 });
  assert.equal(await read(page, "Simulator.pull.body"), 0);
  await eventually("it pulls", async () => {
    const force = await Promise.all(["x", "y", "z"].map((axis) => read(page, `Simulator.pull.force.${axis}`)));
    return Math.hypot(...force) > 0.5;
  });
  // Friction holds 0.3 W: a pull across half the picture is more.
  await page.mouse.move(x + 150, y - 60, { steps: 3 });
  await eventually("the block follows", async () => distance(await position(page), start) > 0.02);
  await page.mouse.up();
  await page.keyboard.up("Control");
  await eventually("it is let go", async () => (await read(page, "Simulator.pull.body")) === -1);
  await eventually("nothing pulls", async () => (await read(page, "Simulator.pull.force.x")) === 0);
  assert.deepEqual(page.problems, []);
});

test("time: paused, a step, a tenth of real time, as fast as possible", async (t) => {
  const { page } = await open(t, block());
  await pause(page);
  const stood = await standing(page);
  await page.getByRole("button", { name: "one step (right arrow)" }).click();
  await eventually("one step", async () => Math.abs((await time(page)) - stood - 1e-3) < 1e-9);

  await speed(page, 0.1);
  await resume(page);
  // A busy machine falls behind; no machine runs ahead, by more than one picture of the page.
  const passed = await page.evaluate(async () => {
    const [clock, simulated] = [performance.now(), await window.hookpoint.time()];
    await new Promise((resolve) => setTimeout(resolve, 2000));
    return ((await window.hookpoint.time()) - simulated) / ((performance.now() - clock) / 1000);
  });
  assert.ok(passed > 0 && passed < 0.2, `${passed} of real time`);

  await speed(page, asFastAsPossible);
  const fast = await page.evaluate(async () => {
    const [clock, simulated] = [performance.now(), await window.hookpoint.time()];
    await new Promise((resolve) => setTimeout(resolve, 1000));
    return ((await window.hookpoint.time()) - simulated) / ((performance.now() - clock) / 1000);
  });
  assert.ok(fast > 2, `${fast} times real time`);
});

test("back in the history and on, a run is what it was", async (t) => {
  // A block that slides and tumbles: nothing of it is at rest.
  const text = block().replace("rest_on = ground;", "location = 0, 0, 0.4; orientation = 20 deg, 30 deg, 0; velocity = 1, 0.3, 0;");
  const { page, folder, file } = await open(t, text);
  await eventually("time passes", async () => (await time(page)) > 0.8);
  await pause(page);
  const scrubber = page.getByRole("slider", { name: "history" });
  await scrubber.fill("0.35");
  await eventually("the past", async () => Math.abs((await time(page)) - 0.35) < 2e-3);
  const going = page.getByRole("button", { name: "go on from here (Space)" });
  await going.click();
  await eventually("on from there", async () => (await time(page)) > 0.6);
  await pause(page);
  await eventually("it stands", async () => {
    const stood = await time(page);
    await page.waitForTimeout(150);
    return stood === (await time(page));
  });
  const reached = await time(page);
  const trails = ["lab.block.position", "lab.block.velocity", "lab.block.angular_velocity"].flatMap((trail) => ["x", "y", "z"].map((axis) => `${trail}.${axis}`));
  const values = [];
  for (const trail of trails) values.push(await read(page, trail));

  // A run that nobody touched. The last row of its record is at that step; a double is read back as it was.
  const plain = await run(["run", file, "--for", `${reached} s`, "--record", trails.join(","), "--out", "plain"], folder);
  assert.equal(plain.status, 0, plain.complaints);
  const rows = readFileSync(`${folder}/plain/trace.csv`, "utf8").trim().split("\n");
  const last = rows[rows.length - 1].split(",").map(Number);
  assert.equal(last[0], reached);
  assert.deepEqual(values, last.slice(1));
  assert.deepEqual(page.problems, []);
});

test("a stiffness edited while it runs: the block lies W/(4 k) deep; the patch has it", async (t) => {
  const { page } = await open(t, block());
  const height = async () => read(page, "lab.block.position.z");
  const depth = (stiffness) => 9.81 / (4 * stiffness);
  assert.ok(Math.abs((await height()) - (0.05 - depth(20_000))) < 1e-6);
  await speed(page, asFastAsPossible);
  await editField(page, "lab.rubber.normal_stiffness", "2000");
  await eventually("it has sunk", async () => Math.abs((await height()) - (0.05 - depth(2000))) < 1e-6);
  await editField(page, "lab.rubber.normal_stiffness", "stiff");
  await page.locator(".problem:not(:empty)").first().waitFor();
  assert.ok(Math.abs((await height()) - (0.05 - depth(2000))) < 1e-6);

  const [download] = await Promise.all([page.waitForEvent("download"),
    page.getByRole("button", { name: "save what was changed as a .hook patch" }).click()]);
  const text = readFileSync(await download.path(), "utf8");
  assert.match(download.suggestedFilename(), /\.hook$/);
  assert.match(text, /normal_stiffness\s*=\s*2000/);
  assert.deepEqual(page.problems, []);
});

test("a saved file is loaded anew, and the camera stays; a wrong one is told of, and the run goes on", async (t) => {
  const { page, folder } = await open(t, block());
  const canvas = widget(page, "camera");
  await canvas.focus();
  for (let i = 0; i < 3; ++i) await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("PageUp");
  const camera = async () => [await read(page, "camera.euler1"), await read(page, "camera.distance")];
  await eventually("the camera has moved", async () => (await camera())[1] !== 1);
  const turned = await unchanging(page, camera);

  experiment(folder, "block.hook", block().replace("mass = 1;", "mass = 2;"));
  const depth = 2 * 9.81 / (4 * 20_000);
  await eventually("twice as heavy", async () => Math.abs((await read(page, "lab.block.position.z")) - (0.05 - depth)) < 1e-6);
  await eventually("the camera is where it was", async () =>
    Math.abs((await read(page, "camera.euler1")) - turned[0]) < 1e-9 && Math.abs((await read(page, "camera.distance")) - turned[1]) < 1e-9);

  experiment(folder, "block.hook", block().replace("mass = 1;", "mass = 1 s;"));
  await page.locator(".notice.error").first().waitFor();
  assert.match(await page.locator(".notice.error").first().textContent(), /mass/);
  const then = await time(page);
  await eventually("it goes on", async () => (await time(page)) > then + 0.05);
  assert.ok(Math.abs((await read(page, "lab.block.position.z")) - (0.05 - depth)) < 1e-6);
  assert.deepEqual(page.problems, []);
});

test("a slider of the state starts the run again from there, paused", async (t) => {
  const { page } = await open(t, block());
  await eventually("it runs", async () => (await time(page)) > 0.1);
  await page.keyboard.press("t");
  await page.getByRole("tab", { name: "State" }).click();
  const height = page.getByRole("textbox", { name: "z, number" });
  await height.fill("0.5");
  await height.press("Enter");
  await eventually("it is there", async () => (await read(page, "lab.block.base.location.z")) === 0.5);
  assert.equal(await time(page), 0);
  const yaw = page.getByRole("textbox", { name: "yaw, number" });
  await yaw.fill("90");
  await yaw.press("Enter");
  await eventually("it is turned", async () => Math.abs((await read(page, "lab.block.base.orientation.z")) - Math.SQRT1_2) < 1e-9);
  assert.equal(await read(page, "lab.block.base.location.z"), 0.5);
  assert.ok(await height.isVisible()); // the page is the same one
  for (let i = 0; i < 3; ++i) await page.getByRole("button", { name: "one step (right arrow)" }).click();
  await eventually("it falls", async () => Math.abs((await read(page, "lab.block.base.location.z")) - (0.5 - 9.81e-6 * 6)) < 1e-12);
  assert.deepEqual(page.problems, []);
});

test("a slider is hatched where its gain makes the step unstable", async (t) => {
  const { page } = await open(t, `
World lab { gravity = 0; deltat = 1 ms;
  Robot arm { Base.fixed {} Chain c { Link l { mass = 1; center_of_mass = 0.5,0,0; inertia = 0,0,0,0,0,0; } } } }
Controller.PD pd { pconstant = 100; dconstant = 10; Wire FROM lab.arm.c.l.angle TO current; Wire FROM output TO lab.arm.c.l.torque; }
Window {
  Window.grob camera { drawer = lab; }
  Valuator.Slider damping { range = 10,1000; Wire TO pd.dconstant; }
  Valuator.Slider aim { range = -1,1; Wire TO pd.goal; }
}`);
  const slider = widget(page, "damping");
  await eventually("it is marked", async () => ((await slider.getAttribute("title")) ?? "") !== "");
  // 2 x 0.25 kg m^2 / 1 ms - 1 ms x 100 / 2 = 499.95
  assert.match(await slider.getAttribute("title"), /^the step of 0\.001 s is unstable from (499|500)\.?\d* to 1000/);
  const mark = page.locator(".slider .unstable span");
  assert.equal(await mark.count(), 1);
  const [whole, part] = [await slider.boundingBox(), await mark.boundingBox()];
  assert.ok(Math.abs(part.width / whole.width - 0.5) < 0.05, `${part.width} of ${whole.width}`);
  assert.deepEqual(page.problems, []);
});
