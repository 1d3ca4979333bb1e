// A browser and a server for a file of tests.
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before } from "node:test";
import { chromium } from "playwright-core";
import { root, serve } from "../server.mjs";

export { program, root, serve } from "../server.mjs";

export const paperCase = join(root, "cases/paper-table1/scenario.toml");
export const scratch = mkdtempSync(join(tmpdir(), "percuss-page-"));
const FLAGS = [
  "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync",
];
let server, browser;
// What the browser complained about: nothing, if all is well.
export const complaints = [];

export const launch = () => chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: FLAGS });

before(async () => {
  server = await serve();
  browser = await launch();
});

after(async () => {
  await browser?.close();
  server?.child.kill();
  rmSync(scratch, { recursive: true, force: true });
});

// A page that shows the first answer.
export async function open(path = "/", options = {}, address = server.address) {
  const context = await browser.newContext({ viewport: { width: 1360, height: 900 }, ...options });
  const page = await context.newPage();
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("console", (message) => {
    // The browser reports a refused case, which is the answer that is due.
    const refused = message.text().includes("422");
    if (message.type() === "error" && !refused) complaints.push(message.text());
  });
  await page.goto(address + path);
  // Other pages have no answer.
  if (options.javaScriptEnabled !== false && path !== "/materials") await answered(page, 1);
  return page;
}

export const number = (page, label) =>
  page.locator("#numbers div", { has: page.locator(`dt:text-is("${label}")`) }).locator("dd").innerText();
export const answered = (page, times) =>
  page.waitForFunction((n) => Number(document.documentElement.dataset.answers ?? 0) >= n, times);
export const pixels = (page, chart) =>
  page.locator(`figure[data-chart="${chart}"] canvas`).first().evaluate((canvas) => canvas.toDataURL());
// The panel of a study, brought into view by its tab.
export const study = async (page, name) => {
  await page.getByRole("tab", { name, exact: true }).click();
  return page.getByRole("tabpanel", { name, exact: true });
};
