// The axisymmetric answer that refines itself, and the impact as an animation, in a real browser.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { answered, complaints, open, paperCase, program, root, serve } from "./support.mjs";

// Far more than a busy machine takes.
const LIMIT = { timeout: 180_000 };
const impact = (page) => page.locator("#impact");
const told = (page, name) => impact(page).evaluate((element, key) => Number(element.dataset[key]), name);
const refined = (page, meshes) => page.waitForFunction((n) => Number(document.querySelector("#refined").dataset.meshes) >= n && !document.querySelector("#refined.stale"), meshes, LIMIT);
const slider = (page) => page.getByLabel("Time of the impact");
const picture = (page) => impact(page).locator("canvas").evaluate((canvas) => canvas.toDataURL());
const spoken = (text) => text.replaceAll(/\s+/g, " ");
// A case of many seconds on every mesh.
const SLOW = `projectile = { material = "copper", length = "80 mm", diameter = "5 mm", impact_velocity = "900 m/s" }
target = { material = "aluminium-2024-t351", thickness = "semi-infinite" }
axi = { courant = 0.1 }
chain = { projectile_elements = 20, target_elements = 20 }
`;

test("the answer refines itself and has the number of the command line", async () => {
  const page = await open();
  await refined(page, 4);
  const printed = spoken(execFileSync(program, ["run", paperCase], { encoding: "utf8" }));
  const [, number] = /Axisymmetric depth of penetration (.*?) mm: the number to use/.exec(printed);
  const rows = page.locator("#refined .row");
  assert.deepEqual(await rows.locator("span:first-child").allInnerTexts(), ["3 cells", "4 cells", "6 cells", "8 cells", "chain"]);
  assert.equal(await rows.nth(2).locator(".number").innerText(), number);
  // The error bar of four meshes is shorter than that of two.
  const width = async (row) => (await rows.nth(row).locator(".whisker").boundingBox()).width;
  assert.ok((await width(3)) < (await width(1)));
  assert.equal(await rows.nth(0).locator(".whisker").count(), 0);
  assert.match(await page.locator("#refined .headline").innerText(), /depth of penetration, 4 meshes\n.* ± .* mm\none-dimensional \(chain\)\n0\.208 mm, /);
  // Another model stands beside the same answer.
  let asked = 0;
  page.on("request", (request) => (asked += Number(request.url().endsWith("/api/refinement"))));
  await page.locator("#models").selectOption("fdm");
  await page.locator("#refined").getByText("one-dimensional (fdm)").waitFor();
  await page.waitForTimeout(500);
  assert.equal(asked, 0);
  await page.context().close();
});

test("a case that axi does not take says why", async () => {
  const oblique = join(root, "cases/apm2-core-oblique/scenario.toml");
  const printed = spoken(execFileSync(program, ["run", oblique], { encoding: "utf8" }));
  const page = await open();
  await impact(page).locator("canvas").waitFor();
  await page.locator("#cases").selectOption("apm2-core-oblique");
  const said = page.locator("#refined").getByText("No axisymmetric answer");
  await said.waitFor(LIMIT);
  const reason = (await said.innerText()).replace("No axisymmetric answer: ", "").replace(/\.$/, "");
  assert.ok(printed.includes(`no axisymmetric answer: ${reason}`), `${reason}\n${printed}`);
  assert.ok(await impact(page).isHidden());
  await page.context().close();
});

test("the first frame is there within a second, and a change ends the runs", async () => {
  const page = await open();
  await refined(page, 1);
  const ended = [];
  page.on("requestfailed", (request) => ended.push(new URL(request.url()).pathname));
  const count = await page.evaluate(() => Number(document.documentElement.dataset.answers));
  // The page itself notes when it asks: the first frame can be there before the request is seen here.
  await page.evaluate(() => {
    const ask = window.fetch;
    window.fetch = (url, options) => {
      if (String(url).endsWith("api/refinement") && String(options?.body).includes("80 mm")) window.asked ??= performance.now();
      return ask(url, options);
    };
  });
  await page.locator("#text").fill(SLOW);
  await answered(page, count + 1);
  await page.waitForFunction(() => Number(document.querySelector("#impact").dataset.first) > window.asked, undefined, LIMIT);
  const first = (await told(page, "first")) - (await page.evaluate(() => window.asked));
  assert.ok(first < 1000, `${first} ms`);
  // The runs go on for many seconds: a change ends them, and what they gave is pale.
  await page.locator("#field-projectile-impact_velocity").fill("901");
  await page.locator("#impact.stale").waitFor();
  assert.ok(ended.includes("/api/refinement"), ended.join());
  await page.locator("#impact:not(.stale)").waitFor(LIMIT);
  await page.context().close();
});

test("a run that ends early leaves no picture of the case before", async () => {
  const short = await serve("--max-seconds", "20");
  const page = await open("/", {}, short.address);
  await impact(page).locator("canvas").waitFor();
  const count = await page.evaluate(() => Number(document.documentElement.dataset.answers));
  await page.locator("#text").fill(SLOW.replace("80 mm", "160 mm"));
  await answered(page, count + 1);
  const said = page.locator("#refined .note");
  await said.getByText("processor time").waitFor(LIMIT);
  assert.match(await said.innerText(), /^No axisymmetric answer: the runs take about/);
  assert.equal(await page.locator("#refined .headline div").count(), 0);
  assert.ok(await impact(page).isHidden());
  await page.context().close();
  short.child.kill();
});

test("the impact plays, and its time is marked on every chart of time", async () => {
  const page = await open();
  const play = impact(page).locator(".controls button").first();
  await refined(page, 4);
  // It plays unasked to its end, once.
  await page.waitForFunction(() => document.querySelector("#impact .controls button").textContent === "Play", null, LIMIT);
  const count = await told(page, "frames");
  assert.ok(count >= 60 && count <= 120, count);
  assert.equal(await told(page, "cells"), 8);
  assert.ok((await told(page, "bytes")) <= 24 * 2 ** 20);
  assert.equal(await slider(page).inputValue(), String(count - 1));
  await play.click();
  assert.equal(await play.innerText(), "Pause");
  await page.waitForFunction(() => Number(document.querySelector("#impact input[type=range]").value) > 5);
  await play.click();
  const paused = await slider(page).inputValue();
  const first = await picture(page);
  await page.getByRole("button", { name: "One frame on" }).click();
  assert.equal(await slider(page).inputValue(), String(Number(paused) + 1));
  assert.notEqual(await picture(page), first);
  await page.getByRole("button", { name: "One frame back" }).click();
  assert.equal(await picture(page), first);
  await slider(page).focus();
  await page.keyboard.press("End");
  await page.keyboard.press("ArrowLeft");
  assert.equal(await slider(page).inputValue(), String(count - 2));
  const time = await told(page, "time");
  assert.equal(await slider(page).getAttribute("aria-valuetext"), `${time.toFixed(1)} µs`);
  for (const chart of ["depth-time", "velocity-time", "energy-time", "stress-xt"]) {
    const figure = page.locator(`figure[data-chart="${chart}"]`);
    await figure.scrollIntoViewIfNeeded();
    // A chart that comes into view gets its mark then.
    await figure.locator(`.time-mark[data-time="${time.toFixed(3)}"]`).waitFor({ state: "attached" });
  }
  // The legend has the values of the curves there.
  await page.locator('figure[data-chart="depth-time"]').scrollIntoViewIfNeeded();
  const legend = await page.locator('figure[data-chart="depth-time"] .u-legend .u-value').first().innerText();
  assert.ok(Math.abs(Number(legend) - time) < 0.2, `${legend} ${time}`);
  const frame = page.locator('figure[data-chart="depth-time"] .u-over');
  const place = async () => (await frame.locator(".time-mark").boundingBox()).x - (await frame.boundingBox()).x;
  const before = await place();
  await slider(page).focus();
  await page.keyboard.press("Home");
  await page.locator('figure[data-chart="depth-time"]').scrollIntoViewIfNeeded();
  await frame.locator('.time-mark[data-time="0.000"]').waitFor({ state: "attached" });
  assert.ok((await place()) < before);
  // A chart of no time has no mark.
  assert.equal(await page.locator('figure[data-chart="strain-profile"] .time-mark').count(), 0);
  await page.context().close();
});

test("the impact is coloured by four quantities", async () => {
  const page = await open("/", { reducedMotion: "reduce" });
  await refined(page, 4);
  // Nothing moves by itself: the end is shown.
  assert.equal(await slider(page).inputValue(), String((await told(page, "frames")) - 1));
  await slider(page).fill("40");
  const color = page.getByLabel("Colour", { exact: true });
  const seen = new Set();
  for (const label of ["Equivalent plastic strain", "Pressure (MPa)", "Temperature (K)", "Speed (m/s)"]) {
    await color.selectOption({ label });
    seen.add(await picture(page));
    assert.match(await impact(page).locator("canvas").getAttribute("aria-label"), new RegExp(label.split(" ")[0]));
  }
  await color.selectOption({ label: "Pressure (MPa)" });
  await page.getByLabel("range of this frame").check();
  seen.add(await picture(page));
  assert.equal(seen.size, 5);
  // Fast enough for 60 pictures a second, when nothing else takes the processor.
  const times = [];
  for (let at = 10; at < 30; at++) {
    await slider(page).fill(String(at));
    times.push(await told(page, "painted"));
  }
  assert.ok(Math.min(...times) < 16, `${times} ms`);
  await page.context().close();
});

test("rod and crater are drawn to scale and mirrored in the axis", async () => {
  const page = await open("/", { reducedMotion: "reduce" });
  await refined(page, 4);
  await slider(page).fill("0");
  const found = await impact(page).locator("canvas").evaluate((canvas) => {
    const { data, width, height } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    // The projectile where it is at rest in its own colour.
    const own = (x, y) => data[4 * (y * width + x)] === 0xa9 && data[4 * (y * width + x) + 2] === 0xd6;
    let [left, right, top, bottom] = [width, 0, height, 0];
    for (let y = 0; y < height; y++) for (let x = 0; x < width; x++) if (own(x, y)) [left, right, top, bottom] = [Math.min(left, x), Math.max(right, x), Math.min(top, y), Math.max(bottom, y)];
    let unlike = 0;
    for (let y = top; y <= bottom; y++) for (let x = left; x <= right; x++) unlike += Number(own(x, y) !== own(left + right - x, y));
    return { wide: right - left + 1, tall: bottom - top + 1, unlike };
  });
  // 12.74 mm long and 4.8 mm in diameter, edges of a pixel left out.
  assert.ok(Math.abs(found.tall / found.wide - 12.74 / 4.8) < 0.12, JSON.stringify(found));
  assert.ok(found.unlike < 0.02 * found.wide * found.tall, JSON.stringify(found));
  await page.context().close();
});

test("the animation can be taken away", async () => {
  const page = await open("/", { reducedMotion: "reduce" });
  await refined(page, 4);
  const take = async (name) => {
    const [file] = await Promise.all([page.waitForEvent("download", LIMIT), page.getByRole("button", { name }).click()]);
    return [file.suggestedFilename(), readFileSync(await file.path())];
  };
  const [png, still] = await take("Download this frame as PNG");
  assert.match(png, /^paper-table1-impact-[\d.]+us\.png$/);
  assert.deepEqual([still.readUInt32BE(16), still.readUInt32BE(20)], [1920, 1280]);
  const [, moving] = await take("Download the animation as GIF");
  assert.equal(moving.subarray(0, 6).toString("latin1"), "GIF89a");
  // One graphic control extension for each frame.
  let frames = 0;
  for (let at = moving.indexOf("21f904", 0, "hex"); at >= 0; at = moving.indexOf("21f904", at + 3, "hex")) frames++;
  assert.ok(frames >= (await told(page, "frames")), frames);
  const [name, video] = await take("Download the animation as WebM");
  assert.match(name, /\.webm$/);
  assert.equal(video.subarray(0, 4).toString("hex"), "1a45dfa3");
  assert.ok(video.length > 20_000, video.length);
  // A file has one quantity, ends at a press, and is none of a case that has changed.
  const state = impact(page).getByRole("status");
  const gif = page.getByRole("button", { name: "Download the animation as GIF" });
  await gif.click();
  await state.getByText("writing").waitFor();
  assert.ok(await gif.isDisabled());
  await state.getByRole("button", { name: "Cancel" }).click();
  await state.getByText("cancelled").waitFor();
  await gif.click();
  await state.getByText("writing").waitFor();
  await page.locator("#field-projectile-impact_velocity").fill("250");
  await state.getByText("no file: the case was changed").waitFor();
  await page.locator("#field-projectile-impact_velocity").fill("abc");
  await page.locator("#problem").waitFor();
  await page.getByRole("button", { name: "Download this frame as PNG" }).click();
  await state.getByText("no file: this is the impact of the case before it was changed").waitFor();
  console.log(`PNG ${still.length}, GIF ${moving.length}, WebM ${video.length} bytes`);
  await page.context().close();
});

test("the browser had nothing to complain about", () => {
  assert.deepEqual(complaints, []);
});
