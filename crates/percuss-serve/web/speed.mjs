// How long curves take to follow a slider, by the clock, in a real browser. Give it the release build:
//
//   PERCUSS=target/release/percuss node crates/percuss-serve/web/speed.mjs --steps 100
import { readFileSync } from "node:fs";
import { parseArgs } from "node:util";
import { chromium } from "playwright-core";
import { program, serve } from "./server.mjs";

const { values: given } = parseArgs({ options: { steps: { type: "string", default: "100" } } });
const steps = Number(given.steps);

// Moves the slider of the speed and waits each time until the new curves are painted.
const drag = async (count) => {
  const slider = document.getElementById("field-projectile-impact_velocity-slider");
  const root = document.documentElement;
  const times = [];
  const runs = [];
  for (let i = 0; i < count; i++) {
    const before = Number(root.dataset.answers);
    const start = performance.now();
    slider.value = String(50 + (i % 40));
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    await new Promise((done) => {
      const watch = new MutationObserver(() => {
        if (Number(root.dataset.answers) === before) return;
        watch.disconnect();
        // A frame begins with its callbacks; what comes after it was painted.
        requestAnimationFrame(() => setTimeout(done));
      });
      watch.observe(root, { attributes: true });
    });
    times.push(performance.now() - start);
    runs.push(Number(/, (\d+) ms of them/.exec(document.getElementById("status").textContent)?.[1]));
  }
  return { times, runs };
};

const seconds = (pid) => {
  const fields = readFileSync(`/proc/${pid}/stat`, "utf8").split(") ")[1].split(" ");
  return (Number(fields[11]) + Number(fields[12])) / 100;
};
const told = (values) => {
  const sorted = [...values].sort((a, b) => a - b);
  const at = (part) => sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))].toFixed(0);
  return `${at(0)} ms at best, ${at(0.5)} median, ${at(0.9)} for nine in ten, ${at(1)} at most`;
};

const { child, address } = await serve();
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--headless", "--no-sandbox", "--disable-gpu"] });
try {
  const page = await browser.newPage({ viewport: { width: 1360, height: 900 } });
  await page.goto(address);
  await page.waitForFunction(() => document.documentElement.dataset.answers === "1");
  console.log(`${program}, the seed paper's case with 40 and 80 elements, ${steps} steps of a slider`);
  for (const closure of ["default", "column"]) {
    await page.locator("#field-chain-target_resistance").selectOption({ label: closure });
    // The whole answer and the models side by side are there: nothing else is computed.
    await page.waitForTimeout(2000);
    await page.evaluate(drag, 5);
    const [before, clock] = [seconds(child.pid), performance.now()];
    const { times, runs } = await page.evaluate(drag, steps);
    const [used, took] = [seconds(child.pid) - before, performance.now() - clock];
    console.log(`target closure ${closure}:`);
    console.log(`  from the slider to the painted curves: ${told(times)}`);
    console.log(`  run and charts in the server: ${told(runs)}`);
    console.log(`  processor time of the server: ${((1000 * used) / steps).toFixed(1)} ms a step, of ${(took / steps).toFixed(0)} ms`);
  }
} finally {
  await browser.close();
  child.kill();
}
