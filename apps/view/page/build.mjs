// Bundles the page into one file: node build.mjs FILE, or node build.mjs --tests FOLDER for its
// unit tests as plain JavaScript. The same sources give the same bytes.
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));

// Above this a page takes visibly long to start; the program carries it inside.
const greatestSize = 1_000_000;

async function bundled(entry, options) {
  const result = await build({
    absWorkingDir: here,
    entryPoints: [entry],
    bundle: true,
    minify: true,
    write: false,
    charset: "ascii",
    target: "es2022",
    legalComments: "eof",
    logLevel: "warning",
    ...options,
  });
  return result.outputFiles[0].text;
}

async function buildPage(file) {
  const script = await bundled("main.ts", { format: "iife" });
  const style = await bundled("page.css", {});
  const page = readFileSync(join(here, "index.html"), "utf8")
    .replace("/* page.css */", () => style.trim())
    .replace("/* main.ts */", () => script.trim());
  const size = Buffer.byteLength(page);
  if (size > greatestSize) throw new Error(`the page has ${size} bytes, more than ${greatestSize}`);
  mkdirSync(dirname(file), { recursive: true });
  writeFileSync(file, page);
  console.error(`page: ${file}: ${size} bytes`);
}

async function buildTests(folder) {
  mkdirSync(folder, { recursive: true });
  for (const name of readdirSync(join(here, "tests")).filter((each) => each.endsWith(".test.ts"))) {
    const script = await bundled(`tests/${name}`, { format: "esm", platform: "node", minify: false });
    writeFileSync(join(folder, name.replace(/\.ts$/, ".mjs")), script);
  }
}

const [first, second] = process.argv.slice(2);
if (first === "--tests") await buildTests(second);
else await buildPage(first);
