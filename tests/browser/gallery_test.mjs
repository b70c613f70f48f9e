// Each picture of the manual's gallery can be made, and shows something.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { after, before, test } from "node:test";
import { cameraWidth, leastHeight, mostHeight, pictures, takePicture, width } from "./gallery.mjs";
import { openBrowser, program } from "./support.mjs";

const { engines } = JSON.parse(execFileSync(program, ["engines", "--json"]));
let browser;
before(async () => { browser = await openBrowser(); });
after(() => browser?.close());

/// What an image decoder finds in the bytes of a PNG.
async function look(bytes) {
  const page = await browser.newPage();
  try {
    return await page.evaluate(async (base64) => {
      const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${base64}`)).blob());
      const canvas = new OffscreenCanvas(image.width, image.height);
      const context = canvas.getContext("2d");
      context.drawImage(image, 0, 0);
      const pixels = new Uint32Array(context.getImageData(0, 0, image.width, image.height).data.buffer);
      const counts = new Map();
      for (const pixel of pixels) counts.set(pixel, (counts.get(pixel) ?? 0) + 1);
      return { width: image.width, height: image.height, colours: counts.size, commonest: Math.max(...counts.values()) / pixels.length };
    }, bytes.toString("base64"));
  } finally {
    await page.close();
  }
}

for (const name of Object.keys(pictures)) {
  const missing = engines.find(({ name: engine, found }) => pictures[name].needs?.includes(engine) && !found)?.name;
  test(`${name} is a picture`, { skip: missing && `engine ${missing} is not found` }, async (t) => {
    const bytes = await takePicture(t, browser, name);
    assert.equal(bytes.subarray(0, 8).toString("latin1"), "\x89PNG\r\n\x1a\n");
    assert.ok(bytes.length < 250_000, `${bytes.length} bytes are too many for the manual`);
    const seen = await look(bytes);
    assert.equal(seen.width, pictures[name].camera ? cameraWidth : width);
    assert.ok(seen.height >= leastHeight && seen.height <= mostHeight, `${seen.height} pixels high`);
    // Words, frames and sliders alone, without what canvases show, have some 650; a camera's picture has none of them.
    assert.ok(seen.colours > (pictures[name].camera ? 400 : 800), `${seen.colours} colours`);
    assert.ok(seen.commonest < 0.95, `${100 * seen.commonest} % are of one colour`);
  });
}
