// Creep made visible: the same block under another engine and another integrator, beside the run.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { asFastAsPossible, configs, eventually, openBrowser, openPage, pause, read, resume, serve, speed, time, workFolder } from "./support.mjs";

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
  for (const text of cells) assert.notEqual(text, "");
  const predicted = await read(page, "Subjects[0].displacement_predicted");
  const measured = await read(page, "Subjects[0].penetration"), foretold = await read(page, "Subjects[0].penetration_predicted");
  t.diagnostic(`displacement ${own} of ${predicted}, penetration ${measured} of ${foretold}; ODE ${ode}`);
  assert.ok(Math.abs(predicted - gives) < 1e-6 * gives, `${predicted} m, not ${gives}`);
  assert.ok(Math.abs(measured - foretold) < 0.01 * foretold, `${measured} m, not ${foretold}`);
  assert.deepEqual(page.problems, []);
});
