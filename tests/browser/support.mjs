// What the tests in a browser share: the program under test, Debian's Chromium, and the page that the
// one serves and the other shows.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { connect } from "node:net";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
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
  const context = await browser.newContext({ viewport: { width: 800, height: 600 }, ...options });
  const page = await context.newPage();
  page.problems = [];
  page.on("pageerror", (error) => page.problems.push(String(error)));
  page.on("console", (message) => message.type() === "error" && page.problems.push(message.text()));
  await page.goto(url);
  await drawn(page);
  await page.getByRole("combobox", { name: "quality of the picture" }).selectOption("low");
  return page;
}

export const drawn = (page) =>
  page.waitForFunction(() => Number(document.querySelector("canvas[data-trail]")?.dataset.frames ?? 0) > 0, null, { timeout: 60_000 });
export const widget = (page, trail) => page.locator(`[data-trail="${trail}"]`);
export const read = (page, trail) => page.evaluate((name) => window.hookpoint.read(name).then(({ value }) => value), trail);
export const time = (page) => page.evaluate(() => window.hookpoint.time());
export const set = (page, trail, value) => page.evaluate(([name, number]) => window.hookpoint.set(name, number), [trail, value]);

export const pause = (page) => page.getByRole("button", { name: "pause (Space)" }).click();
export const resume = (page) => page.getByRole("button", { name: /^(run|go on from here) \(Space\)$/ }).click();
export const speed = (page, factor) => page.getByRole("combobox", { name: "speed" }).selectOption(String(factor));
/// 0 is as fast as possible.
export const asFastAsPossible = "0";

/// Writes a file of the experiment and answers its path.
export function experiment(folder, name, text) {
  const path = join(folder, name);
  writeFileSync(path, text);
  return path;
}

/// `hookpoint WORDS...` to its end: its exit status and what it said.
export function run(words, folder) {
  const child = spawn(program, words, { cwd: folder, stdio: ["ignore", "pipe", "pipe"] });
  let out = "", complaints = "";
  child.stdout.on("data", (bytes) => (out += bytes));
  child.stderr.on("data", (bytes) => (complaints += bytes));
  return new Promise((resolve) => child.on("close", (status) => resolve({ status, out, complaints })));
}

/// A line to the program by a plain socket (RFC 6455; docs/view_protocol.md), for who draws nothing. `hear` gets each whole message, as
/// an object or as the numbers of a binary one.
export function openLine(url, hear, failed) {
  const { host, port, search } = new URL(url);
  const socket = connect(Number(port), "127.0.0.1");
  socket.on("error", failed);
  socket.on("close", () => failed(new Error("the program closed the connection")));
  socket.write(`GET /socket${search} HTTP/1.1\r\nHost: ${host}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n` +
    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
  let bytes = Buffer.alloc(0), parts = [], shaken = false, waiting = [];
  const say = (request) => {
    const text = Buffer.from(JSON.stringify(request));
    const short = text.length < 126;
    // Final text frame with a mask of zeros, which changes nothing.
    const head = short ? [0x81, 0x80 | text.length] : [0x81, 0xfe, text.length >> 8, text.length & 255];
    const frame = Buffer.concat([Buffer.from(head), Buffer.alloc(4), text]);
    if (shaken) socket.write(frame);
    else waiting.push(frame);
  };
  socket.on("data", (more) => {
    bytes = bytes.length === 0 ? more : Buffer.concat([bytes, more]);
    if (!shaken) {
      const end = bytes.indexOf("\r\n\r\n");
      if (end < 0) return;
      shaken = true;
      bytes = bytes.subarray(end + 4);
      for (const frame of waiting) socket.write(frame);
      waiting = [];
    }
    while (bytes.length >= 2) {
      const short = bytes[1] & 127;
      const begin = short === 127 ? 10 : short === 126 ? 4 : 2;
      if (bytes.length < begin) return;
      const size = short === 127 ? Number(bytes.readBigUInt64BE(2)) : short === 126 ? bytes.readUInt16BE(2) : short;
      if (bytes.length < begin + size) return;
      // A long message comes in several frames; what begins with a brace is text.
      if ((bytes[0] & 15) <= 2) parts.push(bytes.subarray(begin, begin + size));
      const whole = (bytes[0] & 0x80) !== 0 ? Buffer.concat(parts) : null;
      bytes = bytes.subarray(begin + size);
      if (whole === null) continue;
      parts = [];
      if (whole[0] === 0x7b) hear(JSON.parse(whole.toString()));
      else if (whole.length % 8 === 0) hear(new Float64Array(whole.buffer.slice(whole.byteOffset, whole.byteOffset + whole.length)));
    }
  });
  return { say, close: () => socket.removeAllListeners("close").destroy() };
}

/// The answer to one request, by a line that is there for nothing else.
export function ask(url, name, fields = {}) {
  return new Promise((resolve, reject) => {
    const line = openLine(url, (answer) => {
      if (answer.id !== 1) return;
      line.close();
      if (answer.error === undefined) resolve(answer);
      else reject(new Error(answer.error));
    }, reject);
    line.say({ id: 1, do: name, ...fields });
  });
}

export const bytesOf = (...path) => readFileSync(join(...path));

/// A block of 1 kg that rests on four corners of `stiffness` [N/m], on which friction holds it.
export const block = (stiffness = 20_000, windows = "") => `
World lab {
  gravity = 9.81;
  deltat = 1 ms;
  Material rubber { normal_stiffness = ${stiffness}; normal_damping = 200; tangential_stiffness = 20000; tangential_damping = 200; static_friction = 0.3; kinetic_friction = 0.3; }
  Terrain.Flat ground { material = rubber; }
  Robot block {
    Base.mobile { rest_on = ground; Shape.Box { dimensions = 0.2,0.2,0.1; mass = 1; } }
  }
  Force push { body = block.base; }
}
Window {
  Window.grob camera { size = 320,240; drawer = lab; follow = lab.block.base; distance = 1; }
  ${windows}
}
`;

/// Resolves once `holds` resolves to true.
export async function eventually(what, holds, milliseconds = 120_000) {
  for (const end = Date.now() + milliseconds; Date.now() < end; ) {
    if (await holds()) return;
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  assert.fail(`never: ${what}`);
}

/// The value of `reading` once two readings a while apart are alike: the page shows what the program said last.
export async function unchanging(page, reading) {
  let last = await reading();
  await eventually("it stays as it is", async () => {
    const before = last;
    await page.waitForTimeout(300);
    last = await reading();
    return JSON.stringify(before) === JSON.stringify(last);
  });
  return last;
}

/// The time at which a paused run stands [s].
export const standing = (page) => unchanging(page, () => time(page));
