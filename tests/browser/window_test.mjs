// Fig. 7's file in a browser: every widget read and moved, transport, history.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { configs, eventually, openBrowser, openPage, read, serve, set, time, widget, workFolder } from "./support.mjs";

const figure7 = `${configs}/paper/fig7_two_joint_arm.hook`;
let browser;
before(async () => { browser = await openBrowser(); });
after(() => browser?.close());

async function open(test, words = []) {
  const served = await serve(test, ["view", figure7, "--no-open", ...words], workFolder(test));
  const page = await openPage(browser, served.url);
  test.after(() => page.context().close());
  return { served, page };
}

test("Fig. 7 has ten sliders, one light button and one button", async (t) => {
  const { page } = await open(t);
  assert.equal(await page.locator("[data-trail] input[type=range], input[type=range][data-trail]").count(), 10);
  assert.equal(await page.locator("button[data-trail][aria-pressed]").count(), 1);
  assert.equal(await page.locator("button[data-trail]:not([aria-pressed])").count(), 1);
  for (const name of ["zoom_factor", "distance", "Euler1_angle", "Euler2_angle"])
    assert.equal(await page.getByRole("slider", { name }).count(), 1, name);
  assert.equal(await page.getByRole("slider", { name: "goal_angle" }).count(), 2);
  assert.deepEqual(page.problems, []);
});

test("moving goal_angle moves the arm", async (t) => {
  const { page } = await open(t);
  const link = "SimpleWorld.simplebot.leg1.link1";
  await set(page, "controllers.pconstant.value", 2000);
  await set(page, "controllers.dconstant.value", 400);
  const slider = page.getByRole("slider", { name: "goal_angle" }).first();
  await slider.fill("1.2");
  await eventually("the controller has its goal", async () => Math.abs((await read(page, "pd1.goal")) - 1.2) < 0.02);
  await eventually("the joint is there", async () => Math.abs((await read(page, `${link}.angle`)) - 1.2) < 0.05);
});

test("pause stands still, and goes on where it stood", async (t) => {
  const { page } = await open(t);
  await eventually("time passes", async () => (await time(page)) > 0.1);
  const pause = widget(page, "Window.pause").or(page.getByRole("button", { name: "pause", exact: true })).first();
  await pause.click();
  await eventually("it is paused", async () => (await read(page, "SimpleWorld.running")) === 0);
  const stood = await time(page);
  await page.waitForTimeout(300);
  assert.equal(await time(page), stood);
  await pause.click();
  await eventually("time passes again", async () => (await time(page)) > stood);
});

test("quit ends the program with status 0", async (t) => {
  const { served, page } = await open(t);
  await page.getByRole("button", { name: "quit" }).click();
  assert.equal(await served.ended, 0);
});

test("space pauses, the right arrow steps, r resets, the history goes back and on", async (t) => {
  const { page } = await open(t);
  await eventually("time passes", async () => (await time(page)) > 0.5);
  await page.keyboard.press("Space");
  await page.waitForTimeout(200);
  const stood = await time(page);
  await page.keyboard.press("ArrowRight");
  await eventually("one step", async () => Math.abs((await time(page)) - stood - 1e-3) < 1e-9);
  const angle = await read(page, "SimpleWorld.simplebot.leg1.link1.angle");
  const scrubber = page.getByRole("slider", { name: /history|time/i }).first();
  await scrubber.fill("0.2");
  await eventually("the past", async () => Math.abs((await time(page)) - 0.2) < 2e-3);
  assert.notEqual(await read(page, "SimpleWorld.simplebot.leg1.link1.angle"), angle);
  await page.keyboard.press("Space");
  await eventually("on from there", async () => (await time(page)) > 0.3);
  await page.keyboard.press("r");
  await eventually("the beginning", async () => (await time(page)) < 0.3);
});
