// Whether everybody can use the page: by keyboard, by names, by contrast.
import assert from "node:assert/strict";
import { test } from "node:test";
import { answered, complaints, open } from "./support.mjs";

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
    await page.getByRole("tab", { name: "Calibrate" }).click();
    await page.getByRole("button", { name: "Calibrate" }).click();
    await page.locator(".study .problem").waitFor();
    assert.deepEqual(await page.evaluate(contrasts), []);
    await page.locator("#field-projectile-diameter").fill("x");
    await page.locator("#problem").waitFor();
    const problem = (await page.evaluate(contrasts)).filter((text) => !text.includes("stale"));
    assert.deepEqual(problem, []);
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
