// The line between program and page: who may speak, what breaks it, and who else is on it.
import assert from "node:assert/strict";
import { request } from "node:http";
import { connect } from "node:net";
import { after, before, test } from "node:test";
import { block, eventually, experiment, openBrowser, openPage, read, serve, time, widget, workFolder } from "./support.mjs";

const text = block(20_000, "Valuator.Slider across { range = -5 N, 5 N; Wire TO lab.push.force.y; }");
let browser;
before(async () => { browser = await openBrowser(); });
after(() => browser?.close());

const shake = { Connection: "Upgrade", Upgrade: "websocket", "Sec-WebSocket-Version": "13", "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==" };
/// The status of the answer, 101 where a WebSocket is given.
const statusOf = (url, headers = {}) => new Promise((resolve, reject) => {
  const asked = request(url, { headers, agent: false });
  asked.on("response", (answer) => {
    answer.resume();
    resolve(answer.statusCode);
  });
  asked.on("upgrade", (answer, socket) => {
    socket.destroy();
    resolve(answer.statusCode);
  });
  asked.on("error", reject);
  asked.end();
});

test("who has no token, or comes from elsewhere, is refused", async (t) => {
  const folder = workFolder(t);
  const served = await serve(t, ["view", experiment(folder, "block.hook", text), "--no-open"], folder);
  const page = new URL(served.url), socket = new URL(served.url);
  socket.pathname = "/socket";
  const own = { Origin: page.origin };
  assert.equal(await statusOf(page), 200);
  assert.equal(await statusOf(socket, { ...shake, ...own }), 101);
  for (const wrong of ["", "?token=", `?token=${page.searchParams.get("token").slice(1)}`, "?token=00000000000000000000000000000000"])
    for (const path of ["/", "/socket", "/anything"])
      assert.equal(await statusOf(`${page.origin}${path}${wrong}`, path === "/socket" ? { ...shake, ...own } : {}), 403, path + wrong);
  for (const origin of ["http://example.org", `http://127.0.0.1:1`, "null", `https://${page.host}`])
    assert.equal(await statusOf(socket, { ...shake, Origin: origin }), 403, origin);
  assert.equal(await statusOf(page, { Host: "example.org" }), 403);
  assert.equal(await statusOf(socket, { ...shake, Host: `example.org:${page.port}` }), 403);

  // A page from elsewhere that a browser shows, with the token: its script gets no connection.
  const stranger = await (await browser.newContext()).newPage();
  t.after(() => stranger.context().close());
  await stranger.goto("data:text/html,<title>elsewhere</title>");
  const opened = await stranger.evaluate((url) => new Promise((resolve) => {
    const line = new WebSocket(url);
    line.onopen = () => resolve(true);
    line.onerror = () => resolve(false);
  }), `ws://${socket.host}${socket.pathname}${socket.search}`);
  assert.equal(opened, false);
});

test("two pages see the same, and one that never reads is in nobody's way", async (t) => {
  const folder = workFolder(t);
  const served = await serve(t, ["view", experiment(folder, "block.hook", text), "--no-open"], folder);
  const url = new URL(served.url);
  const deaf = connect(Number(url.port), "127.0.0.1");
  deaf.on("error", () => {});
  t.after(() => deaf.destroy());
  deaf.pause();
  deaf.write(`GET /socket${url.search} HTTP/1.1\r\nHost: ${url.host}\r\n${Object.entries(shake).map(([name, value]) => `${name}: ${value}\r\n`).join("")}\r\n`);

  const [one, other] = await Promise.all([openPage(browser, served.url), openPage(browser, served.url)]);
  t.after(() => Promise.all([one.context().close(), other.context().close()]));
  await one.getByRole("slider", { name: "across" }).fill("2.5");
  await eventually("the other's slider is there", async () => Number(await other.getByRole("slider", { name: "across" }).inputValue()) === 2.5);
  assert.equal(await read(other, "lab.push.force.y"), 2.5);
  await other.keyboard.press("Space");
  await one.getByRole("button", { name: "run (Space)" }).waitFor();
  await eventually("both stand at one time", async () => (await time(one)) === (await time(other)));
  await one.keyboard.press("Space");
  const then = await time(one);
  await eventually("it goes on", async () => (await time(one)) > then + 0.5);

  // One goes; the other does not notice.
  await other.context().close();
  await one.getByRole("slider", { name: "across" }).fill("1");
  await eventually("it is heard", async () => (await read(one, "lab.push.force.y")) === 1);
  assert.deepEqual(one.problems, []);
});

test("a program that is gone is told of, and found again when it is back", async (t) => {
  const folder = workFolder(t);
  const file = experiment(folder, "block.hook", text);
  const token = "0123456789abcdefghij";
  const served = await serve(t, ["view", file, "--no-open", "--token", token], folder);
  const page = await openPage(browser, served.url);
  t.after(() => page.context().close());
  served.child.kill("SIGKILL");
  await served.ended;
  const lost = page.getByText("connection lost, trying again");
  await lost.waitFor();
  await assert.rejects(read(page, "lab.time"), /no connection/);

  const again = await serve(t, ["view", file, "--no-open", "--token", token, "--port", new URL(served.url).port], folder);
  assert.equal(again.url, served.url);
  await lost.waitFor({ state: "hidden" });
  await page.getByRole("slider", { name: "across" }).fill("1.5");
  await eventually("it is heard", async () => (await read(page, "lab.push.force.y")) === 1.5);
  const frames = Number(await widget(page, "camera").getAttribute("data-frames"));
  await eventually("it is drawn", async () => Number(await widget(page, "camera").getAttribute("data-frames")) > frames);
});
