// Creep made visible: the same block under another engine and another integrator, beside the run.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { asFastAsPossible, block, configs, eventually, experiment, openBrowser, openPage, pause, read, resume, serve, set, speed, time, workFolder } from "./support.mjs";

let browser;
before(async () => { browser = await openBrowser(); });
after(() => browser?.close());

test("--with ode and rk4: two ghosts, their displacements, and what is predicted of them", async (t) => {
  const served = await serve(t, ["view", `${configs}/scenes/sloped_block.hook`, "--with", "ode", "--with", "rk4", "--for", "10000 s", "--no-open"], workFolder(t));
  const page = await openPage(browser, served.url);
  t.after(() => page.context().close());
  const rows = page.getByRole("table", { name: "creep of each subject" }).locator("tbody tr");
  assert.equal(await rows.count(), 3);
  const names = await rows.locator("th").allTextContents();
  assert.match(names[1], /ode/);
  assert.match(names[2], /rk4/);
  assert.deepEqual(await rows.evaluateAll((each) => each.map((row) => row.dataset.trail)), ["Subjects[0]", "Subjects[1]", "Subjects[2]"]);

  await speed(page, asFastAsPossible);
  const displacementsAfter = async (moment) => {
    await eventually("time passes", async () => (await time(page)) > moment);
    await pause(page);
    await eventually("it stands", async () => {
      const stood = await time(page);
      await page.waitForTimeout(150);
      return stood === (await time(page));
    });
    return { time: await time(page), of: await Promise.all([0, 1, 2].map((i) => read(page, `Subjects[${i}].displacement`))) };
  };
  const early = await displacementsAfter(2);
  await resume(page);
  const late = await displacementsAfter(2 * early.time);
  // Four hooks, k each, give W sin/(4 k) and no more: the feet creep nowhere.
  const gives = 9.81 * Math.sin(20 * Math.PI / 180) / (4 * 20_000);
  const [own, ode, rk4] = late.of;
  assert.ok(Math.abs(own - gives) < 0.01 * gives, `${own} m, not ${gives}`);
  assert.ok(Math.abs(rk4 - own) < 0.05 * gives, `${rk4} m, not ${own}`);
  assert.ok(Math.abs(own - early.of[0]) < 1e-9, `${own} m, before ${early.of[0]}`);
  // ODE has no hooks: its box is held elsewhere.
  assert.ok(ode > 0 && ode < 0.01 && Math.abs(ode - own) > 1e-6, `ODE: ${ode} m`);

  // Beside the number what is predicted: a column of its own, a number in the run's row.
  const cells = await rows.first().locator("td").allTextContents();
  assert.equal(cells.length, 8);
  assert.ok((await page.getByRole("columnheader", { name: "predicted" }).count()) > 0);
  for (const text of cells) assert.notEqual(text, "");
  const predicted = await read(page, "Subjects[0].displacement_predicted");
  const measured = await read(page, "Subjects[0].penetration"), foretold = await read(page, "Subjects[0].penetration_predicted");
  t.diagnostic(`displacement ${own} of ${predicted}, penetration ${measured} of ${foretold}; ODE ${ode}`);
  assert.ok(Math.abs(predicted - gives) < 1e-6 * gives, `${predicted} m, not ${gives}`);
  assert.ok(Math.abs(measured - foretold) < 0.01 * foretold, `${measured} m, not ${foretold}`);
  assert.deepEqual(page.problems, []);
});

test("fit exaggerates as far as all stay in the picture; who has left is told at its edge", async (t) => {
  const served = await serve(t, ["view", `${configs}/views/creep_side_by_side.hook`, "--no-open"], workFolder(t));
  const page = await openPage(browser, served.url, { viewport: { width: 1280, height: 800 } });
  t.after(() => page.context().close());
  const gone = () => page.locator("canvas[data-trail=camera]").getAttribute("data-gone");
  await eventually("it has crept", async () => (await time(page)) > 2);
  await pause(page);
  await set(page, "camera.exaggeration", 100_000);
  await eventually("the fastest is told", async () => /impulses [0-9.]+ (\u00b5m|mm)/.test(await gone()));
  await page.getByRole("button", { name: "fit", exact: true }).click();
  await eventually("none has left", async () => (await gone()) === "");
  const factor = await read(page, "camera.exaggeration");
  assert.ok(factor > 100 && factor < 100_000, `${factor}`);
  await set(page, "camera.exaggeration", 1.5 * factor);
  await eventually("half as much again is too much", async () => (await gone()) !== "");
  assert.match(await page.getByRole("table", { name: "creep of each subject" }).locator("tbody tr").first().locator("td").first().textContent(), /^31\.\d+ \u00b5m$/);
  assert.deepEqual(page.problems, []);
});

test("what nothing predicts has no column", async (t) => {
  const folder = workFolder(t);
  const flight = experiment(folder, "flight.hook", block().replace("rest_on = ground;", "location = 0, 0, 5000;"));
  const served = await serve(t, ["view", flight, "--with", "rk4", "--no-open"], folder);
  const page = await openPage(browser, served.url);
  t.after(() => page.context().close());
  await eventually("time passes", async () => (await time(page)) > 0.3);
  assert.equal(await page.locator("thead th", { hasText: "displacement" }).count(), 1);
  assert.equal(await page.getByRole("columnheader", { name: "predicted" }).count(), 0);
});
