// What a page that looks on costs a run that goes as fast as possible: the insect of Fig. 1a with and without one, by turns.
// By hand: tests/browser/run.sh BUILD_FOLDER cost_bench.mjs. On the two cores of a small machine the browser itself, which draws by
// software here, takes processor time from the run; the steps of a second of the program's own processor time leave that out.
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { ask, configs, openBrowser, openPage, serve, workFolder } from "./support.mjs";

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

test("steps a second with and without a page", { timeout: 300_000 }, async (t) => {
  const served = await serve(t, ["view", scene, "--no-open"], workFolder(t));
  const plain = [], watched = [];
  await ask(served.url, "speed", { factor: 0 });
  for (let turn = 0; turn < turns; ++turn) {
    await new Promise((resolve) => setTimeout(resolve, 500));
    plain.push(await measure(served));
    const page = await openPage(browser, served.url);
    watched.push(await measure(served));
    await page.context().close();
  }
  for (const kind of ["elapsed", "processor"]) {
    const [without, beside] = [plain, watched].map((each) => median(each.map((one) => one[kind])));
    t.diagnostic(`steps a second of ${kind} time: ${without.toFixed(0)} without a page, ${beside.toFixed(0)} with one: ${(100 * (without / beside - 1)).toFixed(1)} % slower`);
  }
});
