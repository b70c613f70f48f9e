// The manual as a site in a real browser: a stranger's questions are found by its search, equations and pictures are drawn, no page is
// wider than the screen, in light and in dark.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";
import { after, before, test } from "node:test";
import { configs, openBrowser } from "./support.mjs";

// As they are asked in trackers of other engines; what is typed, the page that answers, and its words.
const questions = [
  ["Why does a standing robot drift slowly?", "why does my robot slip", "docs/faq.html", "a standing foot drifts slowly"],
  ["Which time step is stable?", "largest stable step", "docs/contact.html", "largest stable step"],
  ["What is my stiffness in solref?", "stiffness solref", "docs/translate.html", "solref"],
  ["Does it start in my keyframe?", "MJCF keyframe", "docs/mjcf.html", "keyframe"],
  ["My meshes are missing: do feet touch the ground?", "meshes hull", "docs/urdf.html", "convex hull"],
  ["Are stairs vertical?", "stairs riser", "docs/terrain.html", "riser"],
  ["Can a leg be a closed four-bar linkage?", "closed linkage loop", "docs/loops.html", "Loop"],
  ["How do I get foot forces as CSV?", "record csv rate", "docs/data.html", "CSV"],
  ["How do I step a thousand worlds at once?", "Batch worlds threads", "docs/python.html", "Batch"],
  ["Can I compare an engine of my own?", "engine program protocol", "docs/engine_protocol.html", "protocol"],
  ["My ball rolls for ever.", "rolling resistance", "docs/contact.html", "rolling_resistance"],
  ["Can the ground be a treadmill?", "treadmill", "docs/obstacles.html", "a treadmill"],
  ["Do two robots touch each other?", "contact between robots", "docs/contact_geometry.html", "bodies of different robots touch"],
  ["The foot is rubber: which friction holds?", "friction of foot and ground", "docs/contact.html", "material of that foot"],
  ["Why is my URDF's inertia refused?", "invalid inertia", "docs/urdf.html", "inertia = repair"],
  ["Why does a thrown stick gain energy?", "spinning body unstable", "docs/integrators.html", "mean velocity of the step"],
  ["Can a servo have a top speed?", "velocity limit", "docs/joints.html", "velocity_limit"],
  ["How do I go back to a saved state?", "continue a run from a saved state", "docs/movies.html", "--resume"],
];
const kinds = { ".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".json": "application/json", ".svg": "image/svg+xml" };

const folder = mkdtempSync(join(tmpdir(), "hookpoint-site-"));
let browser, server, address, missing;
before(async () => {
  const root = join(configs, "..");
  const made = spawnSync("/usr/bin/python3", [join(root, "scripts/site"), join(folder, "site")], { encoding: "utf8" });
  if (made.status === 3) {
    missing = made.stdout + made.stderr;
    return;
  }
  assert.equal(made.status, 0, made.stdout + made.stderr);
  server = createServer((request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url, "http://here").pathname));
    try {
      const bytes = readFileSync(join(folder, "site", path.endsWith("/") ? `${path}index.html` : path));
      response.writeHead(200, { "Content-Type": kinds[extname(path) || ".html"] ?? "application/octet-stream" }).end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  address = `http://127.0.0.1:${server.address().port}`;
  browser = await openBrowser();
});
after(async () => {
  await browser?.close();
  server?.close();
  rmSync(folder, { recursive: true, force: true });
});

const patience = 120_000;
async function open(t, path, options = {}) {
  const page = await browser.newPage(options);
  t.after(() => page.close());
  page.setDefaultTimeout(patience);
  const wrong = [];
  page.on("pageerror", (error) => wrong.push(String(error)));
  page.on("requestfailed", (request) => wrong.push(`${request.url()} failed`));
  page.on("response", (response) => { if (response.status() >= 400) wrong.push(`${response.url()}: ${response.status()}`); });
  page.on("request", (request) => { if (!request.url().startsWith(address) && !request.url().startsWith("data:")) wrong.push(`it asks ${request.url()}`); });
  await page.goto(`${address}/${path}`, { waitUntil: "networkidle" });
  return { page, wrong };
}

for (const [question, typed, path, words] of questions)
  test(question, async (t) => {
    if (missing) return t.skip(missing);
    const { page } = await open(t, "index.html");
    await page.locator(".md-search__input").first().click();
    await page.keyboard.type(typed);
    await page.locator(".md-search-result__link").first().waitFor();
    await page.waitForTimeout(500);
    const links = await page.locator(".md-search-result__item > .md-search-result__link").evaluateAll((found) => found.map((link) => new URL(link.href).pathname.slice(1)));
    const most = 5;  // that fit without scrolling
    assert.ok(links.slice(0, most).includes(path), `${typed}: ${links.slice(0, most).join(", ")}`);
    const answer = await open(t, path);
    assert.ok((await answer.page.locator("article").innerText()).includes(words), words);
  });

test("equations, pictures and tables are drawn, and no page is wider than the screen", async (t) => {
  if (missing) return t.skip(missing);
  for (const width of [390, 900, 1600])
    for (const path of ["index.html", "docs/theory.html", "docs/contact.html", "docs/findings.html", "docs/command_line.html"]) {
      const { page, wrong } = await open(t, path, { viewport: { width, height: 900 } });
      assert.deepEqual(wrong, [], path);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
      assert.ok(wide <= 0, `${path} at ${width}: ${wide} too wide`);
      const broken = await page.locator("article img").evaluateAll((images) => images.filter((image) => image.complete && image.naturalWidth === 0).map((image) => image.src));
      assert.deepEqual(broken, [], path);
      if (path === "docs/theory.html") assert.ok(await page.locator(".katex").count() > 20, "equations");
    }
});

test("no page at all is wider than a telephone's screen", async (t) => {
  if (missing) return t.skip(missing);
  const { page } = await open(t, "index.html", { viewport: { width: 390, height: 900 } });
  const pages = readdirSync(join(folder, "site"), { recursive: true }).filter((path) => path.endsWith(".html"));
  assert.ok(pages.length > 100, `${pages.length} pages`);
  const wide = [];
  for (const path of pages) {
    await page.goto(`${address}/${path}`, { waitUntil: "load" });
    const beyond = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
    if (beyond > 0) wide.push(`${path}: ${beyond} px`);
  }
  assert.deepEqual(wide, []);
});

test("it is dark where the reader's screen is", async (t) => {
  if (missing) return t.skip(missing);
  const brightness = async (colorScheme) => {
    const { page } = await open(t, "docs/faq.html", { colorScheme });
    const [r, g, b] = (await page.evaluate(() => getComputedStyle(document.body).backgroundColor)).match(/\d+/g).map(Number);
    return (r + g + b) / 3;
  };
  assert.ok(await brightness("light") > 200);
  assert.ok(await brightness("dark") < 80);
});
