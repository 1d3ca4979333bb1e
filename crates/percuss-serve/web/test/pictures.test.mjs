// Pictures of the page, for the documentation and for whoever looks.
import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
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
    // Without motion the last frame of the impact is shown.
    const page = await open("/", { ...options, reducedMotion: "reduce" });
    await page.locator("#comparison-body table").waitFor();
    await page.locator('#refined[data-meshes="4"]').waitFor({ timeout: 60_000 });
    const wider = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wider <= 0, `${name} is ${wider} px wider than the window`);
    await page.screenshot({ path: join(folder, `${name}.png`) });
    if (process.env.WHOLE) await page.screenshot({ path: join(folder, `${name}-whole.png`), fullPage: true });
    await page.context().close();
  }
});

// Sizes in CSS pixels: a phone, a tablet held upright, a laptop and a desktop.
const SIZES = [[390, 844], [768, 1024], [1360, 900], [1920, 1080]];

test("the page fits four sizes of windows, light and dark, and a sheet shows them", async () => {
  const name = "serve-sizes";
  const folder = process.env.SCREENSHOTS ? resolve(root, process.env.SCREENSHOTS) : scratch;
  mkdirSync(folder, { recursive: true });
  const page = await open("/", { reducedMotion: "reduce" });
  await page.locator("#comparison-body table").waitFor();
  await page.locator('#refined[data-meshes="4"]').waitFor({ timeout: 60_000 });
  const rows = [];
  for (const colorScheme of ["light", "dark"]) {
    await page.emulateMedia({ colorScheme, reducedMotion: "reduce" });
    const row = [];
    for (const [width, height] of SIZES) {
      await page.setViewportSize({ width, height });
      await page.evaluate(() => scrollTo(0, 0));
      await page.waitForTimeout(300);
      const size = `${width} × ${height}, ${colorScheme}`;
      const wider = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(wider <= 0, `${size}: ${wider} px wider than the window`);
      const headline = await page.locator("#refined").boundingBox();
      assert.ok(headline.y >= 0 && headline.y + headline.height <= 1.5 * height, `${size}: the depth is far down, at ${headline.y} px`);
      const picture = (await page.screenshot()).toString("base64");
      row.push(`<figure><img src="data:image/png;base64,${picture}"><figcaption>${size}</figcaption></figure>`);
    }
    rows.push(row.join(""));
  }
  // A page of the server could have no styles within.
  const sheet = await page.context().browser().newPage();
  await page.context().close();
  await sheet.setContent(`<style>
    body { margin: 8px; background: #fff; font: 16px sans-serif } div { display: flex; gap: 12px; margin-bottom: 12px }
    figure { margin: 0 } img { height: 390px; border: 1px solid #888 } figcaption { text-align: center }
  </style>${rows.map((row) => `<div>${row}</div>`).join("")}`);
  const wide = await sheet.evaluate(() => document.documentElement.scrollWidth);
  await sheet.setViewportSize({ width: wide, height: 900 });
  await sheet.screenshot({ path: join(folder, `${name}.png`), fullPage: true });
  await sheet.close();
});

test("a picture of the impact", async () => {
  const name = "serve-impact";
  const folder = process.env.SCREENSHOTS ? resolve(root, process.env.SCREENSHOTS) : scratch;
  const page = await open("/", { viewport: { width: 1360, height: 1100 }, reducedMotion: "reduce" });
  await page.locator('#refined[data-meshes="4"]').waitFor({ timeout: 60_000 });
  await page.getByLabel("Time of the impact").fill("45");
  const boxes = [];
  for (const figure of ["#impact", 'figure[data-chart="depth-time"]']) boxes.push(await page.locator(figure).boundingBox());
  const [x, y] = [boxes[0].x, boxes[0].y];
  const clip = { x, y, width: boxes[0].width, height: boxes[1].y + boxes[1].height - y };
  await page.mouse.move(0, 0);
  await page.screenshot({ path: join(folder, `${name}.png`), clip });
  await page.context().close();
});

// A picture of a study of a case, once it says something.
async function pictured(name, title, example, prepare, says, height = 900) {
  const folder = process.env.SCREENSHOTS ? resolve(root, process.env.SCREENSHOTS) : scratch;
  const page = await open("/", { viewport: { width: 1360, height } });
  await page.locator("#cases").selectOption(example);
  await answered(page, 2);
  await page.locator("#comparison-body table").waitFor();
  const of = await study(page, title);
  await prepare(of, page);
  await of.getByRole("button", { name: title, exact: true }).click();
  await of.getByText(says).first().waitFor({ timeout: 120_000 });
  await of.evaluate((element) => scrollTo(0, element.getBoundingClientRect().top + scrollY - 70));
  await page.waitForTimeout(300);
  const wider = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  assert.ok(wider <= 0, `${wider} px wider than the window`);
  await page.screenshot({ path: join(folder, `serve-${name}.png`) });
  if (process.env.WHOLE) await of.screenshot({ path: join(folder, `serve-${name}-whole.png`) });
  await page.context().close();
}

test("a picture of an analysis of uncertainty", () =>
  pictured("uncertainty", "Uncertainty", "paper-table1-uncertainty", (of) => of.getByLabel("samples").selectOption("64"), "The spread is that of the inputs"));

test("a picture of a sweep", () =>
  pictured("sweep", "Sweep", "paper-table1", async (of) => {
    await of.getByLabel("from", { exact: true }).fill("150 m/s");
    await of.getByLabel("to", { exact: true }).fill("400 m/s");
    await of.getByRole("button", { name: "Add parameter" }).click();
    const second = of.locator(".range").nth(1);
    await second.getByLabel("number", { exact: true }).selectOption("materials.aluminium-2024-t351.strength.power_law.coefficient");
    await second.getByLabel("from", { exact: true }).fill("400 MPa");
    await second.getByLabel("to", { exact: true }).fill("1000 MPa");
  }, "44 runs:"));

test("a picture of a calibration", () =>
  pictured("calibrate", "Calibrate", "taylor-copper-wilkins", async (of, page) => {
    await page.locator("#models").selectOption("wilkins_guinan");
    await answered(page, 3);
    await of.getByLabel("method", { exact: true }).selectOption("sample");
    // A sample that is worth a picture takes a minute.
    await of.getByLabel("steps", { exact: true }).fill(process.env.SCREENSHOTS ? "150" : "8");
  }, "Measured and predicted values", 1150));

test("the browser had nothing to complain about", () => {
  assert.deepEqual(complaints, []);
});
