// Whether the pinned playwright-core drives the installed browser: status 0; 1 with both versions where it does not.
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { openBrowser } from "./support.mjs";

try {
  const browser = await openBrowser();
  const page = await browser.newPage();
  const sum = await page.evaluate(() => 1 + 1);
  await browser.close();
  if (sum !== 2) throw new Error(`1 + 1 is ${sum}`);
} catch (error) {
  const playwright = JSON.parse(readFileSync("node_modules/playwright-core/package.json", "utf8")).version;
  const browser = execFileSync(process.env.HOOKPOINT_BROWSER, ["--version"]).toString().trim();
  console.log(`playwright-core ${playwright} does not drive ${browser}: ${String(error).split("\n")[0]}`);
  process.exit(1);
}
