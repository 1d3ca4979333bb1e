// The case and its answer in a real browser, served by the program.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { answered, complaints, number, open, paperCase, pixels, program, scratch } from "./support.mjs";

test("the first paint shows the answer", async () => {
  const still = await open("/", { javaScriptEnabled: false });
  assert.equal(await number(still, "depth of penetration"), "0.208 mm");
  await still.context().close();

  const page = await open();
  const asked = [];
  page.on("request", (request) => asked.push(new URL(request.url()).pathname));
  // Without the state that the address has taken on by now.
  await page.goto(new URL("/", page.url()).href);
  await answered(page, 1);
  assert.equal(await number(page, "depth of penetration"), "0.208 mm");
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

// A slider asks for the next answer while one is computed.
test("a field keeps its last value when the answer to an earlier one arrives", async () => {
  const page = await open();
  const release = [];
  await page.route("**/api/answer", async (route) => {
    await new Promise((resolve) => release.push(resolve));
    await route.continue();
  });
  const count = await page.evaluate(() => Number(document.documentElement.dataset.answers));
  await page.locator("#field-projectile-impact_velocity-slider").evaluate((slider) => {
    for (const place of ["200", "300"]) {
      slider.value = place;
      slider.dispatchEvent(new Event("input"));
    }
  });
  const speed = await page.locator("#field-projectile-impact_velocity").inputValue();
  for (let answer = 0; answer < 2; answer++) {
    while (release.length <= answer) await page.waitForTimeout(10);
    release[answer]();
    await answered(page, count + answer + 1);
    assert.equal(await page.locator("#field-projectile-impact_velocity").inputValue(), speed);
  }
  assert.ok((await page.locator("#text").inputValue()).includes(`impact_velocity = "${speed} m/s"`));
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
  // The browser may hold the last movements back until the next frame; the slider has its last place when it says that it has changed.
  await slider.evaluate((input) => input.addEventListener("change", () => (window.released = true)));
  await page.mouse.up();
  await page.waitForFunction(() => window.released);
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
  const exact = printed.results[0].depth_of_penetration_mm;
  // The answer to the last place of the slider may still be on its way.
  const read = async () => Number((await number(page, "depth of penetration")).split(" ")[0]);
  for (let i = 0; i < 50 && Math.abs((await read()) / exact - 1) >= 5e-3; i++) {
    await page.waitForTimeout(100);
  }
  const depth = await read();
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
  await page.context().close();
});

test("the materials are a table that words and a range of hardness narrow", async () => {
  const page = await open();
  await page.goto(new URL("/materials", page.url()).href);
  const ids = () => page.locator("#materials tbody tr:not([hidden]) code").allInnerTexts();
  const listed = (...words) => JSON.parse(execFileSync(program, ["materials", ...words, "--json"], { encoding: "utf8" })).map(({ id }) => id);
  const same = async (...words) => assert.deepEqual((await ids()).sort(), listed(...words).sort(), words.join(" "));
  await same();
  for (const words of ["armor", "Aluminum 7039", "al", "pb", "rha"]) {
    await page.getByLabel("Words").fill(words);
    await same(words);
  }
  assert.match(await page.locator("#count").innerText(), /^\d+ of \d+ materials$/);
  await page.getByLabel("Words").fill("");
  await page.getByLabel("Group").selectOption("steel");
  await page.getByLabel("from", { exact: true }).fill("350");
  await page.getByLabel("to", { exact: true }).fill("400");
  await same("--group", "steel", "--hardness", "350..400");
  await page.getByLabel("Words").fill("unobtainium");
  assert.deepEqual(await ids(), []);
  await page.context().close();

  // Without a script all are there.
  const still = await open("/materials", { javaScriptEnabled: false });
  assert.equal(await still.locator("#materials tbody tr").count(), listed().length);
  assert.ok(await still.locator("#filter").isHidden());
  await still.context().close();
});

test("a material is found in the form by an alias", async () => {
  const page = await open();
  await page.getByLabel("Find a material: material").first().fill("ti64");
  const values = await page.locator("#field-projectile-material option").evaluateAll((all) => all.map((option) => option.value));
  assert.ok(values.includes("ti-6al-4v") && values.includes("copper") && !values.includes("rha"), values.join());
  assert.equal(await page.locator("#field-projectile-material").inputValue(), "copper");
  await page.keyboard.press("Enter");
  await answered(page, 2);
  assert.equal(await page.locator("#field-projectile-material").inputValue(), "ti-6al-4v");
  assert.match(await page.locator("#text").inputValue(), /material = "ti-6al-4v"/);
  assert.ok((await page.locator("#field-projectile-material option").count()) > 80);
  await page.context().close();
});

test("an empty field shows the value in use", async () => {
  const page = await open();
  const chosen = (id) => page.locator(id).evaluate((select) => select.selectedOptions[0].textContent);
  assert.equal(await chosen("#field-chain-target_resistance"), "expanding-cavity (default)");
  assert.equal(await chosen("#field-projectile-nose"), "flat (default)");
  await page.locator("#field-target-thickness").fill("3");
  await answered(page, 2);
  assert.equal(await chosen("#field-chain-target_resistance"), "column (default)");
  await page.locator("#field-target-thickness").fill("25");
  await answered(page, 3);
  await page.locator("#field-chain-target_elements").fill("");
  await page.locator("#field-chain-target_elements").blur();
  await page.waitForFunction(() => document.getElementById("field-chain-target_elements").placeholder === "80 (default)");
  await page.context().close();
});

test("warnings are counted where the answer is, and the link leads to them", async () => {
  const page = await open();
  const link = page.locator("#refined a[href='#warnings']");
  const count = await page.locator("#warnings li").count();
  assert.ok(count > 0);
  assert.equal(await link.innerText(), count === 1 ? "1 warning" : `${count} warnings`);
  const seen = await link.boundingBox();
  assert.ok(seen.y + seen.height < 500, `${seen.y}`);
  // The card grows with each mesh.
  await page.locator('#refined[data-meshes="4"]').waitFor({ timeout: 60_000 });
  await page.locator("#warnings summary").click();
  await page.locator("#warnings li").first().waitFor({ state: "hidden" });
  await link.click();
  await page.locator("#warnings li").first().waitFor();
  await page.waitForFunction(() => {
    const { top, bottom } = document.querySelector("#warnings").getBoundingClientRect();
    return top >= 0 && bottom <= innerHeight;
  });
  assert.match(new URL(page.url()).hash, /^#s=/);
  await page.context().close();
});

test("the text stands beside the form where there is room", async () => {
  const page = await open("/", { viewport: { width: 1920, height: 1080 } });
  const [form, text, answer] = await Promise.all(["#form", "#text-box", "#own"].map((id) => page.locator(id).boundingBox()));
  assert.ok(text.x >= form.x + form.width && Math.abs(text.y - form.y) < 2, JSON.stringify([form, text]));
  assert.ok(answer.x >= text.x + text.width, JSON.stringify([text, answer]));
  const wider = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  assert.ok(wider <= 0, `${wider} px wider than the window`);
  await page.context().close();
});

test("a nose that the chain does not take is answered by the model that is chosen then", async () => {
  const page = await open();
  assert.equal(await page.locator("#models").evaluate((menu) => menu.selectedOptions[0].textContent), "automatic: chain");
  await page.locator("#field-projectile-nose").selectOption('"hemisphere"');
  await answered(page, 2);
  assert.equal(await page.locator("#models").evaluate((menu) => menu.selectedOptions[0].textContent), "automatic: crater_energy");
  assert.ok(await page.locator("#problem").isHidden());
  // A model that was chosen by hand stays, and says why it does not apply.
  await page.locator("#models").selectOption("chain");
  await page.locator("#problem").waitFor();
  assert.equal(await page.locator("#models").inputValue(), "chain");
  await page.context().close();
});

test("the link has the case as it stands, a refused one too", async () => {
  const page = await open();
  await page.locator("#field-projectile-impact_velocity").fill("-5");
  await page.locator("#problem").waitFor();
  await page.locator("#link").click();
  await page.waitForFunction(() => document.getElementById("status").textContent.startsWith("the link is"));
  const link = page.url();
  const other = await open(new URL(link).pathname + new URL(link).hash);
  await other.locator("#problem").waitFor();
  assert.match(await other.locator("#text").inputValue(), /impact_velocity = "-5 m\/s"/);
  await page.context().close();
  await other.context().close();
});

test("a changed case says so, and goes back step by step", async () => {
  const page = await open();
  const speed = page.locator("#field-projectile-impact_velocity");
  const title = () => page.locator('figure[data-chart="depth-time"] figcaption').innerText();
  assert.doesNotMatch(await title(), /\(changed\)/);
  await speed.fill("300");
  await answered(page, 2);
  assert.match(await title(), /\(changed\)/);
  assert.equal(await page.locator("#cases").inputValue(), "");
  await speed.fill("350");
  await answered(page, 3);
  await speed.fill("-350");
  await page.locator("#problem").waitFor();
  await speed.blur();
  await page.locator("#undo").click();
  await page.locator("#problem").waitFor({ state: "hidden" });
  await page.waitForFunction(() => document.getElementById("field-projectile-impact_velocity").value === "350");
  await page.context().close();
});

test("a field that is emptied and filled keeps the comment of its key", async () => {
  const page = await open();
  const text = await page.locator("#text").inputValue();
  await page.locator("#text").fill(text.replace('length = "12.74 mm"', 'length = "12.74 mm" # measured'));
  await answered(page, 2);
  const length = page.locator("#field-projectile-length");
  await length.fill("");
  await length.fill("13");
  await page.waitForFunction(() => document.getElementById("text").value.includes('length = "13 mm" # measured'));
  // Without a value the case lacks it, and the field is marked.
  await length.fill("");
  await length.blur();
  await page.locator("#problem").waitFor();
  assert.equal(await length.getAttribute("aria-invalid"), "true");
  await page.context().close();
});

test("a bad number outlives another unit", async () => {
  const page = await open();
  const length = page.locator("#field-projectile-length");
  await length.fill("12,5");
  await page.locator("#problem").waitFor();
  await page.locator("#field-projectile-length + select").selectOption("in");
  assert.equal(await length.inputValue(), "12,5");
  await page.context().close();
});

test("an option that goes back to its default takes its table along", async () => {
  const page = await open();
  const text = await page.locator("#text").inputValue();
  await page.locator("#field-chain-published-small_strain").evaluate((input) => input.closest("details").setAttribute("open", ""));
  await page.locator("#field-chain-published-small_strain").selectOption({ index: 1 });
  await page.locator("#problem").waitFor();
  await page.locator("#field-chain-published-small_strain").selectOption({ index: 0 });
  await page.locator("#problem").waitFor({ state: "hidden" });
  const left = (await page.locator("#text").inputValue()).replace(" (changed)", "");
  assert.equal(left, text);
  await page.context().close();
});

test("what is typed while the server does not respond is not lost", async () => {
  const page = await open();
  await page.route("**/api/answer", (route) => route.fulfill({ status: 422, contentType: "application/json", body: "{}" }));
  await page.locator("#field-projectile-impact_velocity").fill("450");
  await page.locator("#problem").waitFor();
  await page.unroute("**/api/answer");
  await page.locator("#field-projectile-diameter").fill("5");
  await answered(page, 2);
  const text = await page.locator("#text").inputValue();
  assert.match(text, /impact_velocity = "450 m\/s"/);
  assert.match(text, /diameter = "5 mm"/);
  await page.context().close();
});

test("a server that is back answers at the press of a button", async () => {
  const page = await open();
  complaints.length = 0;
  await page.route("**/api/answer", (route) => route.abort());
  await page.locator("#field-projectile-impact_velocity").fill("450");
  await page.locator("#problem").getByText("the server does not respond").waitFor();
  await page.unroute("**/api/answer");
  await page.locator("#problem").getByRole("button", { name: "Try again" }).click();
  await answered(page, 2);
  assert.match(await page.locator("#text").inputValue(), /impact_velocity = "450 m\/s"/);
  assert.ok(complaints.splice(0).every((words) => words.includes("ERR_FAILED")));
  await page.context().close();
});

test("a refused case outlives a reload, and pales all that is of another", async () => {
  const page = await open();
  const text = `${await page.locator("#text").inputValue()}\n# my notes\n[experiments`;
  const address = page.url();
  await page.locator("#text").fill(text);
  await page.locator("#problem").waitFor();
  for (const part of ["#numbers", "#impact", 'figure[data-chart="depth-time"]', "#comparison-body"]) {
    const opacity = await page.locator(part).evaluate((element) => Number(getComputedStyle(element).opacity));
    assert.ok(opacity < 0.5, `${part}: ${opacity}`);
  }
  await page.waitForFunction((before) => location.href !== before, address);
  await page.reload();
  await page.locator("#problem").waitFor();
  assert.equal(await page.locator("#text").inputValue(), text);
  await page.context().close();
});

test("the menu of files lies above the rest, and closes", async () => {
  const page = await open("/", { viewport: { width: 800, height: 900 } });
  await page.locator("#refined .row .number").first().waitFor({ timeout: 120_000 });
  const menu = page.locator("details.menu");
  await menu.locator("summary").click();
  for (const file of await menu.locator("button").all()) {
    const isOnTop = await file.evaluate((element) => {
      const { left, top, width, height } = element.getBoundingClientRect();
      return element.contains(document.elementFromPoint(left + width / 2, top + height / 2));
    });
    assert.ok(isOnTop, await file.innerText());
  }
  await Promise.all([page.waitForEvent("download"), menu.getByText("scenario.toml").click()]);
  assert.equal(await menu.getAttribute("open"), null);
  await menu.locator("summary").click();
  await page.locator("header h1").click();
  assert.equal(await menu.getAttribute("open"), null);
  await page.context().close();
});

test("the browser had nothing to complain about", () => {
  assert.deepEqual(complaints, []);
});
