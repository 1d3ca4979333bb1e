// Whether everybody can use the page: by keyboard, by names, by contrast.
import assert from "node:assert/strict";
import { test } from "node:test";
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { answered, complaints, open, study } from "./support.mjs";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

test("everything is reached by keyboard and has a name", async () => {
  const page = await open();
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll("input, select, textarea, button, summary, a[href], [tabindex='0']")]
      .filter((element) => element.checkVisibility())
      .filter((element) => !(element.labels?.length || element.ariaLabel || element.getAttribute("aria-labelledby") || element.textContent?.trim()))
      .map((element) => element.outerHTML));
  assert.deepEqual(nameless, []);
  await page.keyboard.press("Tab");
  assert.equal(await page.evaluate(() => document.activeElement.className), "skip");
  await page.locator("#field-projectile-impact_velocity-slider").focus();
  await page.keyboard.press("ArrowRight");
  await answered(page, 2);
  assert.notEqual(await page.locator("#field-projectile-impact_velocity").inputValue(), "230");
  await page.context().close();
});

test("the tabulator goes through the page in the order of its parts", async () => {
  const page = await open();
  await page.locator("#comparison-body table").waitFor();
  const seen = [];
  for (let i = 0; i < 120; i++) {
    await page.keyboard.press("Tab");
    const at = await page.evaluate(() => {
      const element = document.activeElement;
      const inside = (selector) => element.closest(selector) !== null;
      const part = ["header", "#form", "#text-box", "#charts", "#comparison", "#studies"].find(inside);
      return { id: element.id, part, ring: getComputedStyle(element).outlineStyle, body: element === document.body };
    });
    if (at.body) break;
    assert.notEqual(at.ring, "none", `${at.id} shows no focus`);
    seen.push(at);
  }
  const parts = seen.map((at) => at.part).filter((part) => part !== undefined);
  const order = parts.filter((part, i) => part !== parts[i - 1]);
  assert.deepEqual(order, ["header", "#form", "#text-box", "#charts", "#comparison", "#studies"]);
  for (const id of ["cases", "models", "link", "field-projectile-impact_velocity", "field-projectile-impact_velocity-slider", "text"]) {
    assert.ok(seen.some((at) => at.id === id), id);
  }
  await page.context().close();
});

// Contrast of text and its ground after WCAG 2: 4.5 at least, 3 for large text.
const contrasts = () => {
  const canvas = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });
  const channels = (css) => {
    canvas.clearRect(0, 0, 1, 1);
    canvas.fillStyle = css;
    canvas.fillRect(0, 0, 1, 1);
    return [...canvas.getImageData(0, 0, 1, 1).data];
  };
  const light = ([r, g, b]) => [r, g, b].map((c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4))
    .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
  const ground = (element) => {
    for (let at = element; at; at = at.parentElement) {
      const color = channels(getComputedStyle(at).backgroundColor);
      if (color[3] === 255) return color;
    }
    return [255, 255, 255, 255];
  };
  const found = [];
  for (const element of document.querySelectorAll("body *")) {
    const own = [...element.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.textContent.trim());
    if (!(own || element.matches("input, select, textarea")) || !element.checkVisibility() || element.matches(":disabled, script, option")) continue;
    const [a, b] = [light(channels(getComputedStyle(element).color)), light(ground(element))];
    const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    if (ratio < 4.5) found.push(`${ratio.toFixed(2)}: ${element.outerHTML.slice(0, 120)}`);
  }
  return found;
};

for (const colorScheme of ["light", "dark"]) {
  test(`text can be told from its ground, ${colorScheme}`, async () => {
    const page = await open("/", { colorScheme });
    await page.locator("#comparison-body table").waitFor();
    assert.deepEqual(await page.evaluate(contrasts), []);
    // A study that is refused.
    const sweep = await study(page, "Sweep");
    await sweep.getByLabel("to", { exact: true }).fill("300 mm");
    await sweep.getByRole("button", { name: "Sweep" }).click();
    await page.locator(".study .problem").waitFor();
    assert.deepEqual(await page.evaluate(contrasts), []);
    await page.locator("#field-projectile-diameter").fill("x");
    await page.locator("#problem").waitFor();
    const problem = (await page.evaluate(contrasts)).filter((text) => !text.includes("stale"));
    assert.deepEqual(problem, []);
    await page.context().close();
  });
}

// What axe finds, as rules with their elements.
async function findings(page) {
  await page.evaluate(axe);
  return page.evaluate(async () => {
    const { violations } = await globalThis.axe.run(document);
    return violations.map(({ id, impact, nodes }) => `${id} (${impact}): ${nodes.map((node) => node.html.slice(0, 160)).join(" | ")}`);
  });
}

const windows = [
  ["a desktop", { viewport: { width: 1360, height: 900 } }],
  ["a wide window", { viewport: { width: 1920, height: 1080 }, colorScheme: "dark" }],
  ["a phone", { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true }],
];
for (const [name, options] of windows) {
  test(`axe finds nothing on ${name}`, async () => {
    const page = await open("/", { ...options, reducedMotion: "reduce" });
    await page.locator("#comparison-body table").waitFor();
    await page.locator('#refined[data-meshes="4"]').waitFor({ timeout: 60_000 });
    assert.deepEqual(await findings(page), [], "/");
    // What is folded away, and a study that has a result.
    await page.locator("details:not(.menu)").evaluateAll((all) => all.forEach((details) => (details.open = true)));
    const models = await study(page, "Models versus velocity");
    await models.getByRole("button", { name: "Models versus velocity" }).click();
    await models.locator("figure canvas").first().waitFor({ timeout: 120_000 });
    assert.deepEqual(await findings(page), [], "/, unfolded");
    for (const path of ["/materials", "/materials/rha"]) {
      await page.goto(new URL(path, page.url()).href);
      await page.locator("h1").waitFor();
      assert.deepEqual(await findings(page), [], path);
      const wider = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(wider <= 0, `${path} is ${wider} px wider than the window`);
    }
    await page.context().close();
  });
}

test("the studies are tabs that the arrow keys walk", async () => {
  const page = await open();
  const list = page.getByRole("tablist", { name: "Studies" });
  const heads = list.getByRole("tab");
  const chosen = () => list.locator("[aria-selected=true]").innerText();
  const seen = () => page.locator("[role=tabpanel]").evaluateAll((all) => all.filter((one) => one.checkVisibility()).map((one) => one.getAttribute("aria-labelledby")));
  const [first, ...others] = await heads.allInnerTexts();
  assert.ok(others.length >= 6, others.join());
  assert.equal(await chosen(), first);
  await heads.first().focus();
  await page.keyboard.press("ArrowRight");
  assert.equal(await chosen(), others[0]);
  assert.equal(await page.evaluate(() => document.activeElement.textContent), others[0]);
  assert.deepEqual(await seen(), ["studies-1-tab"]);
  await page.keyboard.press("End");
  assert.equal(await chosen(), others.at(-1));
  await page.keyboard.press("ArrowRight");
  assert.equal(await chosen(), first);
  await page.keyboard.press("ArrowLeft");
  assert.equal(await chosen(), others.at(-1));
  await page.keyboard.press("Home");
  assert.equal(await chosen(), first);
  assert.equal(await list.locator("[tabindex='0']").count(), 1);
  const heights = await heads.evaluateAll((all) => all.map((one) => one.getBoundingClientRect().height));
  assert.ok(heights.every((height) => height >= 44), heights.join());
  await page.context().close();
});

test("the browser had nothing to complain about", () => {
  assert.deepEqual(complaints, []);
});
