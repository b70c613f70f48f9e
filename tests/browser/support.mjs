// What the tests in a browser share: the program under test, Debian's Chromium, and the page that the
// one serves and the other shows.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";

export const program = process.env.HOOKPOINT_PROGRAM;
export const configs = process.env.HOOKPOINT_CONFIGS;

const flags = ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--disable-quic",
  "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"];

export async function openBrowser() {
  return chromium.launch({ executablePath: process.env.HOOKPOINT_BROWSER, headless: true, args: flags });
}

/// A folder that goes with the test.
export function workFolder(test) {
  const folder = mkdtempSync(join(tmpdir(), "hookpoint-browser-"));
  test.after(() => rmSync(folder, { recursive: true, force: true }));
  return folder;
}

/// `hookpoint WORDS...`, which serves a window: resolves once it has printed its address.
export async function serve(test, words, folder) {
  const child = spawn(program, words, { cwd: folder, stdio: ["ignore", "pipe", "pipe"] });
  let out = "", complaints = "";
  const ended = new Promise((resolve) => child.on("exit", (status, signal) => resolve(status ?? signal)));
  test.after(async () => {
    child.kill("SIGKILL");
    await ended;
  });
  child.stderr.on("data", (bytes) => (complaints += bytes));
  await new Promise((resolve, reject) => {
    child.stdout.on("data", (bytes) => {
      out += bytes;
      if (out.includes("\n")) resolve();
    });
    ended.then((status) => reject(new Error(`it ended with ${status}: ${complaints}`)));
  });
  const url = out.trim();
  assert.match(url, /^http:\/\/127\.0\.0\.1:[0-9]+\/\?token=[0-9A-Za-z_-]+$/);
  return {
    url, child, ended,
    out: () => out,
    complaints: () => complaints,
    /// Asks it to end, as the interrupt key does, and resolves to its exit status.
    interrupt: () => {
      child.kill("SIGINT");
      return ended;
    },
  };
}

/// Its page, which has drawn something. Whatever goes wrong in the page fails the test.
export async function openPage(browser, url, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  const page = await context.newPage();
  page.problems = [];
  page.on("pageerror", (error) => page.problems.push(String(error)));
  page.on("console", (message) => message.type() === "error" && page.problems.push(message.text()));
  await page.goto(url);
  await page.waitForFunction(() => Number(document.querySelector("canvas[data-trail]")?.dataset.frames ?? 0) > 0, null, { timeout: 60_000 });
  return page;
}

export const widget = (page, trail) => page.locator(`[data-trail="${trail}"]`);
export const read = (page, trail) => page.evaluate((name) => window.hookpoint.read(name).then(({ value }) => value), trail);
export const time = (page) => page.evaluate(() => window.hookpoint.time());
export const set = (page, trail, value) => page.evaluate(([name, number]) => window.hookpoint.set(name, number), [trail, value]);

/// Resolves once `holds` resolves to true.
export async function eventually(what, holds, milliseconds = 20_000) {
  for (const end = Date.now() + milliseconds; Date.now() < end; ) {
    if (await holds()) return;
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  assert.fail(`never: ${what}`);
}
