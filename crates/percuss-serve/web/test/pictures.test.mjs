// Pictures of the page, for the documentation and for whoever looks.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { test } from "node:test";
import { answered, complaints, open, root, scratch, study } from "./support.mjs";

test("pictures of the page", async () => {
  const folder = process.env.SCREENSHOTS ? resolve(root, process.env.SCREENSHOTS) : scratch;
  mkdirSync(folder, { recursive: true });
  const pictures = [
    ["serve-light", { viewport: { width: 1360, height: 900 }, colorScheme: "light" }],
    ["serve-dark", { viewport: { width: 1360, height: 900 }, colorScheme: "dark" }],
    ["serve-phone", { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, isMobile: true, hasTouch: true }],
  ];
  for (const [name, options] of pictures) {
    const page = await open("/", options);
    await page.locator("#comparison-body table").waitFor();
    const wider = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wider <= 0, `${name} is ${wider} px wider than the window`);
    await page.screenshot({ path: join(folder, `${name}.png`) });
    if (process.env.WHOLE) await page.screenshot({ path: join(folder, `${name}-whole.png`), fullPage: true });
    await page.context().close();
  }
});

test("a picture of an analysis of uncertainty", async () => {
  const folder = process.env.SCREENSHOTS ? resolve(root, process.env.SCREENSHOTS) : scratch;
  const page = await open("/", { viewport: { width: 1360, height: 900 } });
  await page.locator("#text").fill(readFileSync(join(root, "cases/paper-table1-uncertainty/scenario.toml"), "utf8"));
  await answered(page, 2);
  const of = study(page, "Uncertainty");
  await of.getByLabel("shots").selectOption("64");
  await of.getByRole("button", { name: "Uncertainty" }).click();
  await of.getByText("The spread is that of the inputs").waitFor({ timeout: 120_000 });
  await of.evaluate((element) => scrollTo(0, element.getBoundingClientRect().top + scrollY - 70));
  await page.waitForTimeout(300);
  const wider = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  assert.ok(wider <= 0, `${wider} px wider than the window`);
  await page.screenshot({ path: join(folder, "serve-uncertainty.png") });
  if (process.env.WHOLE) await of.screenshot({ path: join(folder, "serve-uncertainty-whole.png") });
  await page.context().close();
});

test("the browser had nothing to complain about", () => {
  assert.deepEqual(complaints, []);
});
