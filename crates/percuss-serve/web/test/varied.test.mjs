// Sweeps and calibrations in a real browser: chosen, followed, cancelled, what they come to, and what is said to bad input.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { answered, complaints, open, pixels, program, root, scratch, study } from "./support.mjs";

const coarse = readFileSync(join(root, "cases/paper-table1/scenario.toml"), "utf8").replace("= 40", "= 10").replace("= 80", "= 20");
const taylor = readFileSync(join(root, "cases/taylor-copper-wilkins/scenario.toml"), "utf8");

// A page that shows a case by a model.
async function shows(text, model) {
  const page = await open();
  await page.locator("#text").fill(text);
  await answered(page, 2);
  if (model) {
    await page.locator("#models").selectOption(model);
    await answered(page, 3);
  }
  return page;
}
// A file of a study as text.
const take = async (page, of, name) => {
  const [file] = await Promise.all([page.waitForEvent("download"), of.getByRole("button", { name, exact: true }).click()]);
  return [file.suggestedFilename(), readFileSync(await file.path(), "utf8")];
};
const start = (of, name) => of.getByRole("button", { name, exact: true }).click();
// What a command says of files in a folder of their own.
function command(name, files, ...words) {
  const folder = join(scratch, name);
  mkdirSync(folder, { recursive: true });
  for (const [file, text] of Object.entries(files)) writeFileSync(join(folder, file), text);
  return spawnSync(program, words, { cwd: folder, encoding: "utf8" });
}
// Words without the breaks of lines and the frames of a terminal.
const flat = (text) => text.replaceAll(/[\s│]+/g, " ");

test("a sweep of two numbers shows curves, a map, rows and files that the command takes", async () => {
  const page = await shows(coarse);
  const of = await study(page, "Sweep");
  assert.equal(await of.getByLabel("from", { exact: true }).inputValue(), "184 m/s");
  await of.getByLabel("from", { exact: true }).fill("150 m/s");
  await of.getByLabel("to", { exact: true }).fill("400 m/s");
  await of.getByRole("button", { name: "Add parameter" }).click();
  const second = of.locator(".range").nth(1);
  await second.getByLabel("number", { exact: true }).selectOption("chain.constraint_factor");
  await second.getByLabel("from", { exact: true }).fill("1.0");
  await second.getByLabel("to", { exact: true }).fill("3.5");
  assert.ok(await of.getByRole("button", { name: "Add parameter" }).isDisabled());
  await start(of, "Sweep");
  await of.getByText("44 runs:").waitFor({ timeout: 60_000 });
  const curves = of.locator('figure[data-chart="curves-depth_of_penetration_mm"]');
  await curves.locator("canvas").first().waitFor();
  assert.equal(await curves.locator(".u-legend .u-series").count(), 5);
  const depth = await pixels(page, "curves-depth_of_penetration_mm");
  await of.getByLabel("quantity", { exact: true }).selectOption("peak_force_kn");
  assert.notEqual(await pixels(page, "curves-peak_force_kn"), depth);
  await of.getByLabel("style", { exact: true }).selectOption("map");
  await of.locator('figure[data-chart="map-peak_force_kn"] canvas').first().waitFor();
  await of.getByText("The rows").click();
  assert.equal(await of.locator("tbody tr").count(), 44);

  const [sweepName, sweep] = await take(page, of, "sweep.toml");
  const [caseName, scenario] = await take(page, of, "scenario.toml");
  assert.deepEqual([sweepName, caseName], ["sweep.toml", "scenario.toml"]);
  assert.match((await take(page, of, "rows.csv"))[1], /^run,projectile\.impact_velocity_m_s,chain\.constraint_factor,outcome/);
  const files = { "sweep.toml": sweep, "scenario.toml": scenario };
  assert.equal(command("swept", files, "sweep", "sweep.toml", "--out", "rows", "--quiet").status, 0);
  // The figure has the same numbers, and so the same text.
  const [, svg] = await take(page, of, /SVG of the figure/);
  const words = ["sweep", "plot", "rows", "--quantity", "peak_force_kn", "--style", "map", "--x", "projectile.impact_velocity"];
  assert.equal(command("swept", files, ...words).status, 0);
  // Above stands the name of the case, which is that of the folder.
  const drawn = (text) => text.slice(text.indexOf("<g transform"));
  assert.equal(drawn(svg), drawn(readFileSync(join(scratch, "swept/rows/map-peak_force_kn.svg"), "utf8")));
  await page.context().close();
});

test("a sweep is cancelled, and bad input is answered in the words of the command", async () => {
  const page = await shows(readFileSync(join(root, "cases/paper-table1/scenario.toml"), "utf8").replace("= 80", "= 800"));
  const of = await study(page, "Sweep");
  await of.getByLabel("values", { exact: true }).fill("4000");
  await start(of, "Sweep");
  await of.locator("progress").waitFor();
  await of.getByRole("button", { name: "Cancel" }).click();
  await of.getByText("cancelled").waitFor();

  await of.getByLabel("to", { exact: true }).fill("300 mm");
  await start(of, "Sweep");
  const problem = of.locator(".problem");
  await problem.waitFor();
  await of.getByLabel("write the file of the sweep by hand").check();
  const text = await of.getByLabel("File of the sweep", { exact: true }).inputValue();
  const said = command("bad", { "sweep.toml": text, "scenario.toml": coarse }, "sweep", "sweep.toml", "--out", "rows");
  assert.equal(said.status, 2);
  const message = await problem.locator("strong").innerText();
  const help = await problem.locator("p").innerText();
  assert.match(message, /another amount is in m\/s/);
  assert.ok(flat(said.stderr).includes(message), said.stderr);
  assert.ok(flat(said.stderr).includes(help), said.stderr);
  assert.match(await problem.innerText(), /line 7/);

  // By hand it is put right, with words in place of numbers.
  await of.getByLabel("File of the sweep", { exact: true }).fill(text.replace(/linear = .*/, 'values = ["200 m/s"]') + '\n[[parameter]]\nkey = "chain.target_resistance"\nvalues = ["column", "diverging"]\n');
  await start(of, "Sweep");
  await of.getByText("2 runs:").waitFor({ timeout: 60_000 });
  await page.context().close();
});

test("a calibration shows its values, and the command prints the same", async () => {
  const page = await shows(taylor, "wilkins_guinan");
  const of = await study(page, "Calibrate");
  await of.getByLabel("number", { exact: true }).selectOption("materials.copper.strength.power_law.coefficient");
  await of.getByLabel("from", { exact: true }).fill("200 MPa");
  await of.getByLabel("to", { exact: true }).fill("900 MPa");
  await of.getByLabel("seed", { exact: true }).fill("3");
  await start(of, "Calibrate");
  await of.getByText("Measured and predicted values").waitFor({ timeout: 60_000 });
  assert.equal(await of.locator("details[open] tbody tr").count(), 4);
  await of.locator('figure[data-chart="predictive"] canvas').first().waitFor();
  const found = JSON.parse((await take(page, of, "calibration.json"))[1]);
  const [, fit] = await take(page, of, "fit.toml");
  const words = ["calibrate", "taylor-copper-wilkins.toml", "--fit", "fit.toml", "--model", "wilkins_guinan", "--least-squares", "--seed", "3", "--json"];
  const printed = command("fitted", { "taylor-copper-wilkins.toml": taylor, "fit.toml": fit }, ...words);
  const named = (text) => JSON.parse(text.replaceAll("taylor-copper-wilkins", "paper-table1"));
  assert.deepEqual(found, named(printed.stdout));
  assert.match((await take(page, of, "material.toml"))[1], /^\[copper-calibrated\]/);

  await of.getByLabel("method", { exact: true }).selectOption("sample");
  await of.getByLabel("steps", { exact: true }).fill("8");
  await start(of, "Calibrate");
  await of.getByRole("columnheader", { name: "R-hat" }).waitFor({ timeout: 100_000 });
  assert.ok(await of.locator('figure[data-chart="corner"] img').evaluate((image) => image.decode().then(() => image.naturalWidth > 100)));
  await page.context().close();
});

test("a case without measured values is given an example of them", async () => {
  const page = await shows(coarse);
  const of = await study(page, "Calibrate");
  await start(of, "Calibrate");
  await of.getByText("an example is now at the end of its text").waitFor();
  await of.getByText("Measured and predicted values").waitFor({ timeout: 60_000 });
  assert.match(await page.locator("#text").inputValue(), /They are no measurements[^]*\[\[experiments\]\][^]*source = "example"/);
  assert.ok(await page.locator("#problem").isHidden());
  assert.match(await of.innerText(), /Power-law coefficient, copper \(MPa\)/);
  // What stands beside the models is called no experiment.
  await page.locator("#comparison-body").getByText("example, no experiment").waitFor();
  // The example is there already.
  await start(of, "Calibrate");
  await of.getByText("Measured and predicted values").waitFor({ timeout: 60_000 });
  assert.equal((await page.locator("#text").inputValue()).split("[[experiments]]").length, 4);
  await page.context().close();
});

test("a change while the example is on its way is not lost", async () => {
  const page = await shows(coarse);
  const of = await study(page, "Calibrate");
  let asked = 0;
  await page.route("**/api/calibration-example", async (route) => {
    asked++;
    await new Promise((done) => setTimeout(done, 1000));
    await route.continue();
  });
  await start(of, "Calibrate");
  await page.locator("#field-projectile-impact_velocity").fill("260");
  await of.getByText("Measured and predicted values").waitFor({ timeout: 180_000 });
  assert.match(await page.locator("#text").inputValue(), /impact_velocity = "260 m\/s"[^]*\[\[experiments\]\]/);
  assert.equal(asked, 2);
  // A word that is not there is no reason to take another case.
  await of.getByLabel("hold out", { exact: true }).fill("nobody");
  await start(of, "Calibrate");
  await of.locator(".problem").getByText("no measured value comes from `nobody`").waitFor({ timeout: 60_000 });
  assert.equal(await of.getByRole("button", { name: /^Use the example/ }).count(), 0);
  await page.context().close();
});

test("the browser had nothing to complain about", () => {
  assert.deepEqual(complaints, []);
});
