// Streams for HOOKPOINT_STREAM_SECONDS (20): neither the page nor the program grows.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { asFastAsPossible, block, eventually, experiment, openBrowser, openPage, serve, speed, time, workFolder } from "./support.mjs";

const seconds = Number(process.env.HOOKPOINT_STREAM_SECONDS ?? 20);
const text = block(20_000, `
  Valuator.Slider across { range = -5 N, 5 N; Wire TO lab.push.force.y; }
  Table numbers { rows = lab.block.position, lab.block.velocity; }
  Plot rolling { show = lab.block.position.z; window = 2 s; }
`).replace("rest_on = ground;", "location = 0, 0, 0.3; orientation = 20 deg, 30 deg, 0;");
let browser;
before(async () => { browser = await openBrowser(); });
after(() => browser?.close());

test(`${seconds} s of streaming`, { timeout: (seconds + 240) * 1000 }, async (t) => {
  const folder = workFolder(t);
  const served = await serve(t, ["view", experiment(folder, "block.hook", text), "--no-open"], folder);
  const page = await openPage(browser, served.url);
  t.after(() => page.context().close());
  const devtools = await page.context().newCDPSession(page);
  await devtools.send("Performance.enable");
  await devtools.send("HeapProfiler.enable");
  const memory = async () => {
    await devtools.send("HeapProfiler.collectGarbage");
    const { metrics } = await devtools.send("Performance.getMetrics");
    const of = (name) => metrics.find((each) => each.name === name).value;
    const resident = Number(/^VmRSS:\s+(\d+) kB/m.exec(readFileSync(`/proc/${served.child.pid}/status`, "utf8"))[1]) * 1024;
    return { simulated: await time(page), heap: of("JSHeapUsedSize"), nodes: of("Nodes"), listeners: of("JSEventListeners"), resident };
  };
  // What is bounded is full after ten minutes of the run: the history of the last five, half a million instants of a plot.
  await speed(page, asFastAsPossible);
  await eventually("what is bounded is full", async () => (await time(page)) > 600, 600_000);
  await speed(page, 1);
  await page.waitForTimeout(2000);
  const first = await memory();
  await page.waitForTimeout(seconds * 1000);
  const last = await memory();
  const megabytes = (bytes) => (bytes / 2 ** 20).toFixed(1);
  const passed = last.simulated - first.simulated;
  t.diagnostic(`${passed.toFixed(1)} simulated s: page ${megabytes(first.heap)} to ${megabytes(last.heap)} MiB, program ${megabytes(first.resident)} to ${megabytes(last.resident)} MiB, nodes ${first.nodes} to ${last.nodes}`);
  assert.ok(passed > seconds / 10, "it streamed");

  // A plot keeps all of a run: a few thousand points a time that it asks, and the history some minutes; beside them nothing grows.
  const room = 8 * 2 ** 20;
  assert.ok(last.heap < 1.1 * first.heap + room, "the page's heap");
  assert.ok(last.resident < 1.1 * first.resident + room, "the program's memory");
  assert.ok(last.nodes < first.nodes + 200, "the page's nodes");
  assert.ok(last.listeners < first.listeners + 50, "the page's listeners");
  assert.deepEqual(page.problems, []);
});
