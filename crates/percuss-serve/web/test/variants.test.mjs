// Variants side by side, the way back, the report, and room for fingers.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { answered, complaints, number, open } from "./support.mjs";

const LIMIT = { timeout: 60_000 };
const meshes = (page, count) => page.waitForFunction((n) => Number(document.querySelector("#refined").dataset.meshes) >= n && !document.querySelector("#refined.stale"), count, LIMIT);
const speed = (page) => page.locator("#field-projectile-impact_velocity");

test("a change is undone", async () => {
  const page = await open();
  const undo = page.getByRole("button", { name: "Undo" });
  assert.ok(await undo.isDisabled());
  const [text, depth] = [await page.locator("#text").inputValue(), await number(page, "depth of penetration")];
  for (const [value, count] of [["300", 2], ["400", 3]]) {
    await speed(page).fill(value);
    await answered(page, count);
  }
  assert.notEqual(await number(page, "depth of penetration"), depth);
  await undo.click();
  await page.waitForFunction(() => document.getElementById("text").value.includes('"300 m/s"'));
  await answered(page, 4);
  await undo.click();
  await answered(page, 5);
  assert.equal(await page.locator("#text").inputValue(), text);
  assert.equal(await number(page, "depth of penetration"), depth);
  assert.ok(await undo.isDisabled());
  await page.context().close();
});

test("variants stand side by side with what differs", async () => {
  const page = await open();
  const keep = page.getByRole("button", { name: "Keep variant" });
  await meshes(page, 2);
  await keep.click();
  await speed(page).fill("400");
  await answered(page, 2);
  await keep.click();
  // The answer of a kept case is refined in the table as well.
  await meshes(page, 3);
  const box = page.locator("#variants");
  const head = await box.locator("th").allInnerTexts();
  assert.ok(head.includes("projectile.impact_velocity") && !head.includes("projectile.length"), head.join());
  assert.ok(head.some((words) => words.startsWith("Axisymmetric depth")), head.join());
  const rows = await box.locator("tbody tr").allInnerTexts();
  assert.equal(rows.length, 2);
  assert.match(rows[0], /230 m\/s[\s\S]*±[\s\S]*0\.208 mm/);
  assert.match(rows[1], /400 m\/s[\s\S]*± .* mm/);
  await box.getByRole("button", { name: "Show variant 1" }).click();
  await page.waitForFunction(() => document.getElementById("text").value.includes('"230 m/s"'));
  await box.getByRole("button", { name: "Remove variant 2" }).click();
  assert.equal(await box.locator("tbody tr").count(), 1);
  await box.getByRole("button", { name: "Remove variant 1" }).click();
  assert.ok(await box.isHidden());
  await page.context().close();
});

test("the report has headline, pictures, numbers and the case, and needs nothing else", async () => {
  const page = await open();
  await meshes(page, 2);
  await page.getByText("Download", { exact: true }).click();
  const [file] = await Promise.all([page.waitForEvent("download", LIMIT), page.getByRole("button", { name: "report.html" }).click()]);
  assert.equal(file.suggestedFilename(), "paper-table1-report.html");
  const path = await file.path();
  const text = readFileSync(path, "utf8");
  assert.ok(!/(src|href)="(?!data:)/.test(text), "it asks for something else");
  const context = await page.context().browser().newContext({ viewport: { width: 900, height: 1200 } });
  const read = await context.newPage();
  await read.setContent(text);
  const shown = await read.locator("body").innerText();
  for (const part of [/ ± .* mm/, /depth of penetration\n0\.208 mm/, /energy balance error/, /impact_velocity = "230 m\/s"/, /Warnings/]) assert.match(shown, part);
  const sizes = await read.locator("img").evaluateAll((images) => Promise.all(images.map(async (image) => { await image.decode(); return image.naturalWidth; })));
  assert.ok(sizes.length >= 6 && sizes.every((width) => width > 200), sizes.join());
  await context.close();
  await page.context().close();
});

test("the studies are one press away", async () => {
  const page = await open();
  await page.getByRole("button", { name: "Studies", exact: true }).click();
  const top = () => page.locator("#studies-title").evaluate((element) => element.getBoundingClientRect().top);
  assert.ok((await top()) < 400, String(await top()));
  // The axisymmetric answer, the impact and the charts above it come later.
  await meshes(page, 2);
  assert.ok((await top()) > 0 && (await top()) < 400, String(await top()));
  await page.context().close();
});

test("on a phone the answer is first, nothing is cut off, and fingers have room", async () => {
  const page = await open("/", { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
  await meshes(page, 2);
  const places = await page.evaluate(() => ["#refined", "#impact", "#own", "#form"].map((id) => document.querySelector(id).getBoundingClientRect().top));
  assert.deepEqual([...places].sort((a, b) => a - b)[0], places[0]);
  assert.ok(places.slice(0, 3).every((top) => top < places[3]), places.join());
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390);
  const small = await page.evaluate(() =>
    [...document.querySelectorAll("button, select, input:not([type=checkbox]), summary, nav a")]
      .filter((element) => element.checkVisibility() && element.getBoundingClientRect().height < 43.5)
      .map((element) => `${element.getBoundingClientRect().height}: ${element.outerHTML.slice(0, 90)}`));
  assert.deepEqual(small, []);
  await page.context().close();
});

test("the browser had nothing to complain about", () => {
  assert.deepEqual(complaints, []);
});
