// The case and its answer in a real browser, served by the program.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { answered, complaints, number, open, paperCase, pixels, program, scratch } from "./support.mjs";

test("the first paint shows the answer", async () => {
  const still = await open("/", { javaScriptEnabled: false });
  assert.equal(await number(still, "depth of penetration"), "0.203 mm");
  await still.context().close();

  const page = await open();
  const asked = [];
  page.on("request", (request) => asked.push(new URL(request.url()).pathname));
  // Without the state that the address has taken on by now.
  await page.goto(new URL("/", page.url()).href);
  await answered(page, 1);
  assert.equal(await number(page, "depth of penetration"), "0.203 mm");
  for (const chart of ["depth-time", "velocity-time", "energy-time", "stress-xt"]) {
    assert.ok(await page.locator(`figure[data-chart="${chart}"] canvas`).first().isVisible(), chart);
  }
  assert.ok(!asked.includes("/api/answer"), "the first answer comes with the page");
  await page.context().close();
});

test("the numbers are those of the command line, to the last bit", async () => {
  const printed = JSON.parse(execFileSync(program, ["run", paperCase, "--fast", "--json"], { encoding: "utf8" }));
  const page = await open();
  const results = await page.evaluate(() => JSON.parse(document.getElementById("data").textContent).answer.results);
  assert.deepEqual(results, printed);
  await page.context().close();
});

test("curves and text follow a slider while it moves", async () => {
  const page = await open();
  const before = await pixels(page, "depth-time");
  const slider = page.locator("#field-projectile-impact_velocity-slider");
  const box = await slider.boundingBox();
  const y = box.y + box.height / 2;
  await page.mouse.move(box.x + box.width * 0.16, y);
  await page.mouse.down();
  for (let i = 0; i < 8; i++) {
    const count = await page.evaluate(() => Number(document.documentElement.dataset.answers));
    await page.mouse.move(box.x + box.width * (0.18 + 0.05 * i), y);
    await answered(page, count + 1);
  }
  await page.mouse.up();
  // The text has the last place of the slider when its numbers are there.
  await page.waitForFunction(() => {
    const speed = document.getElementById("field-projectile-impact_velocity").value;
    return document.getElementById("text").value.includes(`impact_velocity = "${speed} m/s"`);
  });
  assert.notEqual(await pixels(page, "depth-time"), before);
  const speed = await page.locator("#field-projectile-impact_velocity").inputValue();
  assert.ok(Number(speed) > 500, speed);
  assert.match(await page.locator("#text").inputValue(), new RegExp(`impact_velocity = "${speed} m/s"`));
  // Comments and order of the text stay.
  assert.match(await page.locator("#text").inputValue(), /^# The seed paper's own case/);

  const text = join(scratch, "scenario.toml");
  writeFileSync(text, await page.locator("#text").inputValue());
  const printed = JSON.parse(execFileSync(program, ["run", text, "--fast", "--json"], { encoding: "utf8" }));
  const depth = Number((await number(page, "depth of penetration")).split(" ")[0]);
  const exact = printed.results[0].depth_of_penetration_mm;
  assert.ok(Math.abs(depth / exact - 1) < 5e-3, `${depth} and ${exact}`);
  await page.context().close();
});

test("the form follows the text", async () => {
  const page = await open();
  const text = await page.locator("#text").inputValue();
  await page.locator("#text").fill(text.replace('"230 m/s"', '"1000 ft/s"').replace('"25 mm"', '"semi-infinite"').replace('back_face = "fixed"\n', ""));
  await answered(page, 2);
  assert.equal(await page.locator("#field-projectile-impact_velocity").inputValue(), "1000");
  assert.equal(await page.locator("#field-projectile-impact_velocity + select").inputValue(), "ft/s");
  assert.equal(await page.locator("#field-target-thickness + select").inputValue(), "semi-infinite");
  // Another unit is the same speed.
  await page.locator("#field-projectile-impact_velocity + select").selectOption("m/s");
  await page.waitForFunction(() => document.getElementById("text").value.includes('impact_velocity = "304.8 m/s"'));
  await page.context().close();
});

test("an invalid value is answered as on the command line", async () => {
  const page = await open();
  const text = readFileSync(paperCase, "utf8").replace('"4.8 mm"', '"4.8 kg"');
  const file = join(scratch, "bad.toml");
  writeFileSync(file, text);
  const said = spawnSync(program, ["run", file, "--fast"], { encoding: "utf8" }).stderr.replaceAll(/\s+/g, " ");

  await page.locator("#field-projectile-diameter + select").evaluate((select) => select.append(new Option("kg", "kg")));
  await page.locator("#field-projectile-diameter + select").selectOption("kg");
  const problem = page.locator("#problem");
  await problem.waitFor();
  const message = await problem.locator("strong").innerText();
  assert.ok(said.includes(`error: ${message}`), `${message}\n${said}`);
  const help = await problem.locator("p").last().innerText();
  assert.ok(said.includes(`help: ${help}`), `${help}\n${said}`);
  assert.match(await problem.locator("pre").innerText(), /line 8/);
  assert.equal(await page.locator("#field-projectile-diameter").getAttribute("aria-invalid"), "true");

  await page.locator("#field-projectile-diameter + select").selectOption("mm");
  await page.locator("#field-projectile-diameter").fill("5");
  await problem.waitFor({ state: "hidden" });
  await page.context().close();
});

test("a model that is chosen while an answer is computed stays chosen", async () => {
  const page = await open();
  await page.route("**/api/answer", async (route) => {
    await page.waitForTimeout(150);
    await route.continue();
  });
  await page.locator("#field-projectile-impact_velocity").fill("231");
  await page.locator("#models").selectOption("fdm");
  await answered(page, 3);
  assert.equal(await page.locator("#models").inputValue(), "fdm");
  await page.context().close();
});

test("files of an answer can be taken away", async () => {
  const page = await open();
  const take = async (name) => {
    await page.locator("details.menu").evaluate((menu) => { menu.open = true; });
    const [file] = await Promise.all([page.waitForEvent("download"), page.locator(`#downloads button:text-is("${name}")`).click()]);
    return readFileSync(await file.path(), "utf8");
  };
  assert.equal(await take("scenario.toml"), readFileSync(paperCase, "utf8"));
  assert.match(await take("history.csv"), /^time_us,step,tip_velocity_m_s/);
  assert.match(await take("depth-time.svg"), /<svg/);
  await page.context().close();
});

test("the address restores the page", async () => {
  const page = await open();
  await page.waitForFunction(() => location.hash.startsWith("#s="));
  const first = new URL(page.url()).hash;
  await page.locator("#field-projectile-impact_velocity").fill("400");
  await page.waitForFunction((hash) => location.hash !== hash, first);
  const [link, depth] = [page.url(), await number(page, "depth of penetration")];
  const other = await open(new URL(link).pathname + new URL(link).hash);
  await other.waitForFunction(() => document.querySelector("#field-projectile-impact_velocity")?.value === "400");
  await answered(other, 2);
  assert.equal(await number(other, "depth of penetration"), depth);
  await page.context().close();
  await other.context().close();
});

test("materials have their sources one click away", async () => {
  const page = await open();
  const link = await page.locator(".field.of-material a").first().getAttribute("href");
  await page.goto(new URL(link, page.url()).href);
  assert.match(await page.locator("body").innerText(), /sources/);
  await page.goto(new URL("/materials", page.url()).href);
  assert.ok((await page.locator("li a").count()) >= 28);
  await page.context().close();
});

test("the browser had nothing to complain about", () => {
  assert.deepEqual(complaints, []);
});
