// The page in a real browser, served by the program.
import assert from "node:assert/strict";
import { execFileSync, spawn, spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { chromium } from "playwright-core";

const root = resolve(import.meta.dirname, "../../../..");
const program = join(process.env.CARGO_TARGET_DIR ?? join(root, "target"), "debug/percuss");
const paperCase = join(root, "cases/paper-table1/scenario.toml");
const scratch = mkdtempSync(join(tmpdir(), "percuss-page-"));
const FLAGS = [
  "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync",
];
let server, address, browser;
const complaints = [];

// Serves on a free port; the first line says where.
async function serve(...options) {
  const child = spawn(program, ["serve", "--port", "0", ...options], { stdio: ["ignore", "pipe", "inherit"] });
  const line = await new Promise((done, fail) => {
    let said = "";
    child.stdout.on("data", (part) => {
      said += part;
      if (said.includes("\n")) done(said);
    });
    child.on("exit", (code) => fail(new Error(`the server ended with ${code}`)));
  });
  return { child, address: /http:\/\/\S+/.exec(line)[0] };
}

async function open(path = "/", options = {}) {
  const context = await browser.newContext({ viewport: { width: 1360, height: 900 }, ...options });
  const page = await context.newPage();
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("console", (message) => {
    // The browser reports a refused case, which is the answer that is due.
    const refused = message.text().includes("422");
    if (message.type() === "error" && !refused) complaints.push(message.text());
  });
  await page.goto(address + path);
  return page;
}

const number = (page, label) =>
  page.locator("#numbers div", { has: page.locator(`dt:text-is("${label}")`) }).locator("dd").innerText();
const answered = (page, times) =>
  page.waitForFunction((n) => Number(document.documentElement.dataset.answers ?? 0) >= n, times);
const pixels = (page, chart) =>
  page.locator(`figure[data-chart="${chart}"] canvas`).first().evaluate((canvas) => canvas.toDataURL());

before(async () => {
  ({ child: server, address } = await serve());
  browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: FLAGS });
});

after(async () => {
  await browser?.close();
  server?.kill();
  rmSync(scratch, { recursive: true, force: true });
});

test("the first paint shows the answer", async () => {
  const still = await open("/", { javaScriptEnabled: false });
  assert.equal(await number(still, "depth of penetration"), "0.22352 mm");
  await still.context().close();

  const page = await open();
  const asked = [];
  page.on("request", (request) => asked.push(new URL(request.url()).pathname));
  await page.reload();
  await answered(page, 1);
  assert.equal(await number(page, "depth of penetration"), "0.22352 mm");
  for (const chart of ["depth-time", "velocity-time", "energy-time", "stress-xt"]) {
    assert.ok(await page.locator(`figure[data-chart="${chart}"] canvas`).first().isVisible(), chart);
  }
  assert.ok(!asked.includes("/api/answer"), "the first answer comes with the page");
  await page.context().close();
});

test("the numbers are those of the command line, to the last bit", async () => {
  const printed = JSON.parse(execFileSync(program, ["run", paperCase, "--json"], { encoding: "utf8" }));
  const page = await open();
  const results = await page.evaluate(() => JSON.parse(document.getElementById("data").textContent).answer.results);
  assert.deepEqual(results, printed);
  await page.context().close();
});

test("curves and text follow a slider while it moves", async () => {
  const page = await open();
  await answered(page, 1);
  const before = await pixels(page, "depth-time");
  const slider = page.locator("#field-projectile-velocity-slider");
  const box = await slider.boundingBox();
  const y = box.y + box.height / 2;
  await page.mouse.move(box.x + box.width * 0.16, y);
  await page.mouse.down();
  const times = [];
  for (let i = 0; i < 20; i++) {
    const count = await page.evaluate(() => Number(document.documentElement.dataset.answers));
    await page.mouse.move(box.x + box.width * (0.18 + 0.02 * i), y);
    await answered(page, count + 1);
    times.push(Number(/^(\d+) ms/.exec(await page.locator("#status").innerText())?.[1]));
  }
  await page.mouse.up();
  times.sort((a, b) => a - b);
  console.log(`change to curves: median ${times[10]} ms, slowest ${times.at(-1)} ms over ${times.length} steps`);
  assert.notEqual(await pixels(page, "depth-time"), before);
  const speed = await page.locator("#field-projectile-velocity").inputValue();
  assert.ok(Number(speed) > 500, speed);
  assert.match(await page.locator("#text").inputValue(), new RegExp(`velocity = "${speed} m/s"`));
  // Comments and order of the text stay.
  assert.match(await page.locator("#text").inputValue(), /^# The seed paper's own case/);

  const text = join(scratch, "scenario.toml");
  writeFileSync(text, await page.locator("#text").inputValue());
  const printed = JSON.parse(execFileSync(program, ["run", text, "--json"], { encoding: "utf8" }));
  const depth = Number((await number(page, "depth of penetration")).split(" ")[0]);
  const exact = printed.results[0].depth_of_penetration_mm;
  assert.ok(Math.abs(depth / exact - 1) < 1e-4, `${depth} and ${exact}`);
  await page.context().close();
});

test("the form follows the text", async () => {
  const page = await open();
  await answered(page, 1);
  const text = await page.locator("#text").inputValue();
  await page.locator("#text").fill(text.replace('"230 m/s"', '"1000 ft/s"').replace('"25 mm"', '"semi-infinite"').replace('back_face = "fixed"\n', ""));
  await answered(page, 2);
  assert.equal(await page.locator("#field-projectile-velocity").inputValue(), "1000");
  assert.equal(await page.locator("#field-projectile-velocity + select").inputValue(), "ft/s");
  assert.equal(await page.locator("#field-target-thickness + select").inputValue(), "semi-infinite");
  // Another unit is the same speed.
  await page.locator("#field-projectile-velocity + select").selectOption("m/s");
  await page.waitForFunction(() => document.getElementById("text").value.includes('velocity = "304.8 m/s"'));
  await page.context().close();
});

test("an invalid value is answered as on the command line", async () => {
  const page = await open();
  await answered(page, 1);
  const text = readFileSync(paperCase, "utf8").replace('"4.8 mm"', '"4.8 kg"');
  const file = join(scratch, "bad.toml");
  writeFileSync(file, text);
  const said = spawnSync(program, ["run", file], { encoding: "utf8" }).stderr.replaceAll(/\s+/g, " ");

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

test("a study shows its progress and can be cancelled", async () => {
  const alone = await serve("--max-runs", "1");
  const page = await open();
  await page.goto(alone.address);
  await answered(page, 1);
  // A mesh that keeps a study busy for many seconds.
  await page.locator("#field-chain-target_elements").fill("200");
  await answered(page, 2);
  await page.waitForTimeout(1500);
  const study = page.locator(".study", { has: page.locator('button:text-is("Convergence")') });
  await study.getByRole("button", { name: "Convergence" }).click();
  await page.waitForFunction(() => [...document.querySelectorAll("progress")].some((bar) => bar.value > 0));
  await study.getByRole("button", { name: "Cancel" }).click();
  await study.getByText("cancelled").waitFor();
  // The only place to compute in is free again.
  await page.locator("#field-projectile-velocity").fill("231");
  await answered(page, 3);
  await page.context().close();
  alone.child.kill();
});

test("studies come to an end with tables, curves and files", async () => {
  const page = await open();
  await answered(page, 1);
  await page.locator("#comparison-body table").waitFor();
  assert.match(await page.locator("#comparison-body").innerText(), /Recommended: chain ★/);
  await page.getByRole("button", { name: "Models over speeds" }).click();
  await page.locator(".study figure canvas").first().waitFor({ timeout: 120_000 });
  const [file] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "compare.csv" }).click()]);
  assert.match(readFileSync(await file.path(), "utf8"), /^model,|^impact_velocity_m_s,/m);
  await page.context().close();
});

test("files of an answer can be taken away", async () => {
  const page = await open();
  await answered(page, 1);
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
  await answered(page, 1);
  await page.waitForFunction(() => location.hash.startsWith("#s="));
  const first = new URL(page.url()).hash;
  await page.locator("#field-projectile-velocity").fill("400");
  await page.waitForFunction((hash) => location.hash !== hash, first);
  const [link, depth] = [page.url(), await number(page, "depth of penetration")];
  const other = await open(new URL(link).pathname + new URL(link).hash);
  await other.waitForFunction(() => document.querySelector("#field-projectile-velocity")?.value === "400");
  await answered(other, 2);
  assert.equal(await number(other, "depth of penetration"), depth);
  await page.context().close();
  await other.context().close();
});

test("everything is reached by keyboard and has a name", async () => {
  const page = await open();
  await answered(page, 1);
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll("input, select, textarea, button, a[href]")]
      .filter((element) => element.checkVisibility())
      .filter((element) => !(element.labels?.length || element.ariaLabel || element.textContent?.trim()))
      .map((element) => element.outerHTML));
  assert.deepEqual(nameless, []);
  await page.keyboard.press("Tab");
  assert.equal(await page.evaluate(() => document.activeElement.className), "skip");
  await page.locator("#field-projectile-velocity-slider").focus();
  await page.keyboard.press("ArrowRight");
  await answered(page, 2);
  assert.notEqual(await page.locator("#field-projectile-velocity").inputValue(), "230");
  await page.context().close();
});

test("materials have their sources one click away", async () => {
  const page = await open();
  await answered(page, 1);
  const link = await page.locator(".field.of-material a").first().getAttribute("href");
  await page.goto(address + link);
  assert.match(await page.locator("body").innerText(), /sources/);
  await page.goto(address + "/materials");
  assert.ok((await page.locator("li a").count()) >= 28);
  await page.context().close();
});

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
    await answered(page, 1);
    await page.locator("#comparison-body table").waitFor();
    const wider = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wider <= 0, `${name} is ${wider} px wider than the window`);
    await page.screenshot({ path: join(folder, `${name}.png`) });
    if (process.env.WHOLE) await page.screenshot({ path: join(folder, `${name}-whole.png`), fullPage: true });
    await page.context().close();
  }
});

test("the browser had nothing to complain about", () => {
  assert.deepEqual(complaints, []);
});
