// What a page that looks on costs a run that goes as fast as possible: the insect of Fig. 1a with and without one, by turns.
// By hand: tests/browser/run.sh BUILD_FOLDER cost_bench.mjs. On the two cores of a small machine the browser itself, which draws by
// software here, takes processor time and cache from the run; a listener that hears and asks all that the page does and draws nothing,
// as a page on another machine would, leaves that out, and the steps of a second of the program's own processor time nearly do.
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { ask, configs, openBrowser, openLine, openPage, serve, workFolder } from "./support.mjs";

const scene = process.env.HOOKPOINT_BENCH_SCENE ?? `${configs}/paper/fig1a_hexapod.hook`;
const world = process.env.HOOKPOINT_BENCH_WORLD ?? /^World (\w+)/m.exec(readFileSync(scene, "utf8"))?.[1] ?? "world";
const seconds = 4;
const turns = 3;
let browser;
before(async () => { browser = await openBrowser(); });
after(() => browser?.close());

const median = (numbers) => [...numbers].sort((a, b) => a - b)[Math.floor(numbers.length / 2)];
/// Processor time of all threads [s].
function processorTime(process_) {
  const fields = readFileSync(`/proc/${process_}/stat`, "utf8").replace(/^.*\) /, "").split(" ");
  return (Number(fields[11]) + Number(fields[12])) / 100;
}
async function steps(served) {
  const { values } = await ask(served.url, "read", { trails: [`${world}.step`] });
  return values[0].value;
}
async function measure(served) {
  const [first, clock, worked] = [await steps(served), performance.now(), processorTime(served.child.pid)];
  await new Promise((resolve) => setTimeout(resolve, seconds * 1000));
  const taken = (await steps(served)) - first;
  return { elapsed: taken / ((performance.now() - clock) / 1000), processor: taken / (processorTime(served.child.pid) - worked) };
}

/// Every snapshot, and the trace of every plot five times a second, as the page has them.
function listen(url) {
  const plots = [];
  const find = (widgets) => {
    for (const each of widgets) {
      if (each.type === "Plot") plots.push({ trails: each.traces.flatMap(({ x, y }) => (x === null ? [y] : [x, y])), from: 0 });
      find(each.children ?? []);
    }
  };
  let latest = 0, snapshots = 0, traces = 0, timer = null;
  const line = openLine(url, (message) => {
    if (message.tell === "description") {
      find(message.windows);
      timer = setInterval(() => plots.forEach(({ trails, from }, id) => line.say({ id, do: "trace", trails, from, to: latest, points: 4000 })), 200);
    } else if (message[0] === 1) {
      ++snapshots;
      latest = message[4];
    } else if (message[0] === 2 && message[3] > 0) {
      ++traces;
      plots[message[1]].from = message[3 + message[3]] + 1e-9;
    }
  }, (error) => { throw error; });
  return () => {
    clearInterval(timer);
    line.close();
    return { snapshots, traces };
  };
}

test("steps a second with and without a page", { timeout: 300_000 }, async (t) => {
  const served = await serve(t, ["view", scene, "--no-open"], workFolder(t));
  const kinds = { "without a page": [], "with a listener": [], "with a page": [] };
  await ask(served.url, "speed", { factor: 0 });
  for (let turn = 0; turn < turns; ++turn) {
    await new Promise((resolve) => setTimeout(resolve, 500));
    kinds["without a page"].push(await measure(served));
    const close = listen(served.url);
    kinds["with a listener"].push(await measure(served));
    const { snapshots, traces } = close();
    t.diagnostic(`the listener heard ${snapshots} snapshots and ${traces} traces`);
    const page = await openPage(browser, served.url);
    kinds["with a page"].push(await measure(served));
    await page.context().close();
  }
  for (const time of ["elapsed", "processor"]) {
    const rates = Object.entries(kinds).map(([kind, measured]) => [kind, median(measured.map((one) => one[time]))]);
    for (const [kind, rate] of rates)
      t.diagnostic(`steps a second of ${time} time ${kind}: ${rate.toFixed(0)}, ${(100 * (rates[0][1] / rate - 1)).toFixed(1)} % slower`);
  }
});
