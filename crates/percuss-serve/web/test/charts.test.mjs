// Charts in a real browser: zoom, and what was measured.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { answered, complaints, open, pixels, root } from "./support.mjs";

// Waits for other pixels than these.
async function redrawn(page, chart, before) {
  for (let i = 0; i < 200; i++) {
    const now = await pixels(page, chart);
    if (now !== before) return now;
    await page.waitForTimeout(25);
  }
  throw new Error(`${chart} stays as it is`);
}

test("a chart is zoomed by a rectangle, and a double click shows all of it again", async () => {
  const page = await open();
  const chart = page.locator('figure[data-chart="depth-time"]');
  // The impact, which comes later, moves the charts.
  await page.locator('#refined[data-meshes="4"]').waitFor({ timeout: 60_000 });
  const whole = await pixels(page, "depth-time");
  await chart.scrollIntoViewIfNeeded();
  const box = await chart.locator(".u-over").boundingBox();
  const at = (x, y) => [box.x + x * box.width, box.y + y * box.height];
  // The curve runs along the upper edge.
  await page.mouse.move(...at(0.1, 0.02));
  await page.mouse.down();
  await page.mouse.move(...at(0.3, 0.3), { steps: 4 });
  await page.mouse.move(...at(0.4, 0.5), { steps: 4 });
  await page.mouse.up();
  const reset = chart.getByRole("button", { name: /Show the whole chart/ });
  await reset.waitFor();
  const zoomed = await redrawn(page, "depth-time", whole);
  // A new answer leaves the part that is shown.
  await page.locator("#field-projectile-impact_velocity").fill("240");
  await answered(page, 2);
  await redrawn(page, "depth-time", zoomed);
  assert.ok(await reset.isVisible());
  await page.mouse.dblclick(...at(0.5, 0.5));
  await reset.waitFor({ state: "hidden" });
  await page.context().close();
});

test("a chart is zoomed and moved by keys", async () => {
  const page = await open();
  const chart = page.locator('figure[data-chart="stress-xt"]');
  await chart.scrollIntoViewIfNeeded();
  await chart.locator(".plot").focus();
  let before = await pixels(page, "stress-xt");
  const whole = before;
  for (const key of ["+", "ArrowRight", "ArrowDown", "-", "+"]) {
    await page.keyboard.press(key);
    before = await redrawn(page, "stress-xt", before);
  }
  await page.keyboard.press("0");
  await chart.getByRole("button", { name: /Show the whole chart/ }).waitFor({ state: "hidden" });
  await page.mouse.move(0, 0);
  assert.equal(await redrawn(page, "stress-xt", before), whole);
  await page.context().close();
});

test("what was measured stands in the chart against time, with its error and its source", async () => {
  const page = await open();
  const text = readFileSync(join(root, "cases/taylor-copper-wilkins/scenario.toml"), "utf8");
  const [answer] = await Promise.all([
    page.waitForResponse((response) => response.url().endsWith("/api/answer")),
    page.locator("#text").fill(text.replace('"16.81 mm"', '"16.81 mm"\nuncertainty = "0.1 mm"')),
  ]);
  const legend = page.locator('figure[data-chart="length-time"] .u-legend');
  await legend.getByText("measured 16.81 ± 0.1 mm (wilkins1973)").waitFor();
  const chart = (await answer.json()).charts.find((one) => one.name === "length-time");
  const measured = chart.series.at(-1);
  assert.deepEqual(measured.band.map((ends) => ends.map((end) => Math.round(100 * end) / 100)), [[16.71, 16.91], [16.71, 16.91]]);
  // At another speed nothing was measured.
  await page.locator("#field-projectile-impact_velocity").fill("200");
  await legend.getByText("measured").waitFor({ state: "detached" });
  await page.context().close();
});

test("the browser had nothing to complain about", () => {
  assert.deepEqual(complaints, []);
});
