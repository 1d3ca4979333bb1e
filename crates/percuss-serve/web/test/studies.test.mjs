// Studies in a real browser: started, followed, cancelled, and what they come to.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { answered, complaints, open, paperCase, program, root, scratch, serve, study } from "./support.mjs";

test("a study shows its progress and can be cancelled", async () => {
  const alone = await serve("--max-runs", "1");
  try {
    const page = await open("/", {}, alone.address);
    // A time step that keeps a study busy for seconds.
    await page.locator("details").evaluateAll((all) => all.forEach((details) => (details.open = true)));
    await page.locator("#field-chain-courant").fill("0.01");
    await answered(page, 2);
    // Models side by side take the only place first.
    await page.locator("#comparison-body table").waitFor();
    const convergence = await study(page, "Convergence");
    await convergence.getByRole("button", { name: "Convergence" }).click();
    await page.waitForFunction(() => [...document.querySelectorAll("progress")].some((bar) => bar.value > 0));
    await convergence.getByRole("button", { name: "Cancel" }).click();
    await convergence.getByText("cancelled").waitFor();
    // The only place to compute in is free again.
    await page.locator("#field-projectile-impact_velocity").fill("231");
    await answered(page, 3);
    await page.context().close();
  } finally {
    alone.child.kill();
  }
});

test("studies come to an end with tables, curves and files", async () => {
  const page = await open();
  await page.locator("#comparison-body table").waitFor();
  assert.match(await page.locator("#comparison-body").innerText(), /Recommended: chain ★/);
  await page.getByRole("button", { name: "Models versus velocity" }).click();
  await page.locator(".study figure canvas").first().waitFor({ timeout: 120_000 });
  const [file] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "compare.csv" }).click()]);
  assert.match(readFileSync(await file.path(), "utf8"), /^model,|^impact_velocity_m_s,/m);
  await page.context().close();
});

test("a study names its files after its case, and says which number it does not take", async () => {
  const page = await open();
  await page.locator("#cases").selectOption("weldox-460e-12mm-blunt");
  await answered(page, 2);
  const of = await study(page, "Ballistic limit");
  await of.getByRole("button", { name: "Ballistic limit", exact: true }).click();
  await of.getByText("Range of").waitFor({ timeout: 180_000 });
  assert.match(await of.locator("tbody").first().innerText(), /axi/);
  await page.locator("#cases").selectOption("paper-table1");
  await answered(page, 3);
  const [file] = await Promise.all([page.waitForEvent("download"), of.getByRole("button", { name: "limit.json" }).click()]);
  assert.equal(file.suggestedFilename(), "weldox-460e-12mm-blunt-limit.json");

  const uncertainty = await study(page, "Uncertainty");
  const seed = uncertainty.getByLabel("seed");
  await seed.fill("-3");
  await uncertainty.getByRole("button", { name: "Uncertainty", exact: true }).click();
  const problem = uncertainty.locator(".problem");
  assert.match(await problem.innerText(), /seed: -3\s+allowed: whole numbers from 0 to/);
  assert.equal(await seed.getAttribute("aria-invalid"), "true");
  // A study whose server goes away says so.
  await seed.fill("3");
  await page.route("**/api/study/uncertainty", (route) => route.abort());
  await page.route("**/api/uncertainty-example", (route) => route.abort());
  complaints.length = 0;
  await uncertainty.getByRole("button", { name: "Uncertainty", exact: true }).click();
  await uncertainty.getByText("the server does not respond").waitFor();
  assert.ok(complaints.splice(0).every((words) => words.includes("ERR_FAILED")));
  await page.context().close();
});

// What an analysis of the page came to.
const analysis = async (page, done) => {
  const of = await study(page, "Uncertainty");
  await of.getByRole("button", { name: "Uncertainty", exact: true }).click();
  await of.getByText(done).first().waitFor({ timeout: 120_000 });
  return of;
};
// A file of a study as text.
const take = async (page, of, name) => {
  const [file] = await Promise.all([page.waitForEvent("download"), of.getByRole("button", { name }).click()]);
  return readFileSync(await file.path(), "utf8");
};

test("uncertainty has the numbers of the command line", async () => {
  const coarse = readFileSync(join(root, "cases/paper-table1-uncertainty/scenario.toml"), "utf8").replace("= 40", "= 10").replace("= 80", "= 20");
  const file = join(scratch, "spread.toml");
  writeFileSync(file, coarse);
  const printed = JSON.parse(execFileSync(program, ["uncertainty", file, "--samples", "64", "--seed", "5", "--json"], { encoding: "utf8" }));

  const page = await open();
  await page.locator("#text").fill(coarse);
  await answered(page, 2);
  const of = await study(page, "Uncertainty");
  await of.getByLabel("samples").selectOption("64");
  await of.getByLabel("seed").fill("5");
  await analysis(page, "The spread is that of the inputs");
  const found = JSON.parse(await take(page, of, "uncertainty.json"));
  assert.deepEqual({ ...found, case: "" }, { ...printed, case: "" });
  const text = await of.innerText();
  assert.match(text, /5th percentile/);
  assert.match(text, /Power-law coefficient, plate/);
  for (const chart of ["histogram", "tornado", "indices"]) {
    assert.ok(await of.locator(`figure[data-chart="${chart}-depth-of-penetration"]`).isVisible(), chart);
  }
  assert.match(await take(page, of, "statistics.csv"), /^quantity,runs,mean/);
  await page.context().close();
});

test("a case that says nothing of uncertainty is given an example", async () => {
  const page = await open();
  const of = await analysis(page, "an example is now at the end of its text");
  assert.ok(await of.locator('figure[data-chart="histogram-depth-of-penetration"]').isVisible());
  assert.match(await page.locator("#text").inputValue(), /\[\[uncertainty\.parameter\]\]\nkey = "projectile\.impact_velocity"/);
  assert.ok(await page.locator("#problem").isHidden());
  await of.getByLabel("samples").selectOption("64");
  await of.getByRole("checkbox", { name: "Sobol' indices" }).uncheck();
  await analysis(page, "No Sobol' indices: they were not asked for");
  assert.equal(JSON.parse(await take(page, of, "uncertainty.json")).inputs.length, 4);
  await page.context().close();
});

test("the limit of a case with a fixed rear face is that with a free one, and says so", async () => {
  const page = await open();
  const limit = await study(page, "Ballistic limit");
  await limit.getByRole("button", { name: "Ballistic limit" }).click();
  await limit.getByRole("heading", { name: "Ballistic limit with a free rear face" }).waitFor({ timeout: 120_000 });
  // The plate is too thick for a limit below 2000 m/s: an example is offered too.
  await limit.getByText("No model finds a limit between 0 and 2000 m/s.").waitFor();
  await limit.getByRole("button", { name: "Use the example weldox-460e-12mm-blunt" }).waitFor();
  const found = JSON.parse(await take(page, limit, "limit.json"));
  const free = join(scratch, "free.toml");
  writeFileSync(free, readFileSync(paperCase, "utf8").replace('back_face = "fixed"', 'back_face = "free"'));
  const printed = JSON.parse(execFileSync(program, ["limit", free, "--fast", "--json"], { encoding: "utf8" }));
  assert.deepEqual(found.results, printed.results);
  await page.context().close();
});

test("a study that the case lacks something for offers an example and runs it", async () => {
  const page = await open();
  const text = await page.locator("#text").inputValue();
  await page.locator("#text").fill(text.replace('"25 mm"', '"semi-infinite"').replace('back_face = "fixed"\n', ""));
  await answered(page, 2);
  const limit = await study(page, "Ballistic limit");
  await limit.getByRole("button", { name: "Ballistic limit" }).click();
  await limit.getByRole("button", { name: "Use the example weldox-460e-12mm-blunt" }).click({ timeout: 120_000 });
  await limit.locator("figure canvas").first().waitFor({ timeout: 120_000 });
  const measured = limit.locator("tr", { hasText: "experiment" }).locator("data");
  assert.equal(await measured.getAttribute("title"), "184.5");
  assert.equal(await measured.innerText(), "185");
  assert.match(await page.locator("#text").inputValue(), /ballistic_limit/);
  await page.context().close();
});

test("the browser had nothing to complain about", () => {
  assert.deepEqual(complaints, []);
});
