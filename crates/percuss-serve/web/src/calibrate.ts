// Calibration: parameters of a case fitted to its experiments and measured curves.

import { post } from "./api";
import { figure, make, significant, table, withUnit } from "./dom";
import { labelled, options, type Kind, type Page } from "./panel";
import { Parameters, type Numbers } from "./parameters";
import type { Calibrated, Marginal, Quality } from "./types";

const number = (value: number | null | undefined, digits = 3) => (value == null ? "–" : significant(value, digits));
const percent = (part: number | null | undefined) => (part == null ? "–" : significant(100 * part, 3));
const list = (items: string[]) => make("ul", {}, ...items.map((words) => make("li", {}, words)));

export function calibration(page: Page, numbers: Numbers): Kind {
  const parameters = new Parameters({
    title: "calibration",
    steps: false,
    most: 4,
    first: /\.strength\./,
    around: [0.5, 2],
    head: () => "",
  }, numbers);
  const method = make("select", {}, ...options(["", "least squares"], ["sample", "least squares and posterior sample"]));
  const steps = make("input", { type: "number", min: "4", max: "2400", step: "1", value: "100" });
  const stepsLabel = labelled("steps", steps);
  stepsLabel.hidden = true;
  method.addEventListener("input", () => (stepsLabel.hidden = method.value === ""));
  const noise = make("input", { type: "text", size: "9", value: "estimated", autocomplete: "off" });
  const heldOut = make("input", { type: "text", size: "12", placeholder: "sources", autocomplete: "off" });
  const seed = make("input", { type: "number", min: "0", max: "9007199254740991", step: "1", value: "0" });
  return {
    title: "Calibrate",
    about: "parameters of the case fitted to its experiments and measured curves",
    path: "/api/study/calibrate",
    inputs: [labelled("method", method), stepsLabel, labelled("scatter", noise), labelled("hold out", heldOut), labelled("seed", seed)],
    below: parameters.element,
    body: () => ({
      ...page.request(),
      fit: {
        file: parameters.toml(),
        noise: noise.value,
        steps: method.value ? Number(steps.value) : null,
        seed: Number(seed.value),
        hold_out: heldOut.value.split(/[\s,]+/).filter((source) => source),
      },
    }),
    show: (done) => show(done as Calibrated),
    prepare: () => prepare(page),
    example: {
      name: "taylor-copper-wilkins",
      about: "Four Taylor tests of copper rods, to which the first strength constant is fitted.",
      suits: () => false,
      refusal: /^the case has no measured value/,
      loaded: () => parameters.reset(),
    },
  };
}

function show(done: Calibrated): HTMLElement[] {
  const found = done.calibration;
  const sampled = found.sampling;
  const said: HTMLElement[] = [make("p", {}, `Model ${found.model}, ${found.runs} runs, seed ${found.seed}${sampled ? `; ${sampled.ensembles} ensembles of ${sampled.walkers} walkers, ${sampled.steps} steps after ${sampled.burn_in}` : ""}.`)];
  if (found.findings.length) {
    said.push(make("p", {}, make("b", {}, "Not identified:")), list(found.findings.map((finding) => finding.words)));
  }
  const left = found.left_out;
  const rest = left.length
    ? [make("details", {}, make("summary", {}, `${left.length} measured values left out`), list(left.map((one) => `${one.id}: ${one.reason}`)))]
    : [];
  const material = done.material
    ? [make("details", {}, make("summary", {}, "Calibrated material as table `materials` of a case"), make("pre", { tabindex: "0" }, done.material))]
    : [];
  const warnings = found.warnings.length ? [list(found.warnings)] : [];
  return [...said, parameterTable(done), ...tables(done), ...warnings, ...rest, ...material];
}

const marginal = (of: Marginal | null, factor = 1) =>
  of ? [`${number(factor * of.quantiles[0])} … ${number(factor * of.quantiles[2])}`, of.r_hat.toFixed(3), of.bulk_effective_size.toFixed(0), of.tail_effective_size.toFixed(0)] : ["–", "–", "–", "–"];

function parameterTable({ calibration: found, labels }: Calibrated): HTMLElement {
  const sampled = found.sampling !== null;
  const head = ["parameter", "prior 95 %", "best", "± error", ...(sampled ? ["posterior 95 %", "R-hat", "bulk size", "tail size"] : [])];
  const lines: (string | Node)[][] = found.parameters.map((p, i) => [
    labels[i] ?? p.key,
    `${number(p.prior[0])} … ${number(p.prior[2])}`,
    figure(p.best),
    figure(p.standard_error, 2),
    ...(sampled ? marginal(p.posterior) : []),
  ]);
  const { scatter } = found;
  lines.push(["scatter (%)", scatter.estimated ? "" : "given", percent(scatter.best), "", ...(sampled ? marginal(scatter.posterior, 100) : [])]);
  return table(head, lines);
}

// Tables of the data that there are.
function tables(done: Calibrated): HTMLElement[] {
  const { training, hold_out, predictions: values, curves } = done.calibration;
  return [
    ...(training || hold_out ? [qualityTable(done)] : []),
    ...(curves.length ? [curveTable(done)] : []),
    ...(values.length ? [predictions(done)] : []),
  ];
}

function qualityTable({ calibration: found }: Calibrated): HTMLElement {
  const sampled = found.sampling !== null;
  const line = (name: string, q: Quality) =>
    [name, String(q.count), percent(q.rms_before), percent(q.rms), percent(q.bias), ...(sampled ? [String(q.inside ?? "–")] : [])];
  const lines = [...(found.training ? [line("fitted", found.training)] : []), ...(found.hold_out ? [line("held out", found.hold_out)] : [])];
  return table(["measured values", "count", "RMS before (%)", "RMS (%)", "bias (%)", ...(sampled ? ["in the 95 % interval"] : [])], lines);
}

// Differences from the measured curves.
function curveTable({ calibration: found }: Calibrated): HTMLElement {
  const lines = found.curves.map((c) => [
    `${c.id}${c.held_out ? " (held out)" : ""}`,
    String(c.values),
    figure(c.effective_values),
    figure(c.correlation_time_us, 2),
    c.unit === "us" ? "µs" : c.unit,
    figure(c.before?.rms_difference),
    figure(c.best?.rms_difference),
    percent(c.best?.relative_rms_difference ?? null),
  ]);
  const head = ["measured curve", "values", "effective number", "correlation time (µs)", "unit", "RMS difference before", "RMS difference", "relative (%)"];
  return table(head, lines);
}

// Measured and predicted values.
function predictions({ calibration: found }: Calibrated): HTMLElement {
  const sampled = found.sampling !== null;
  const lines = found.predictions.map((p) => [
    `${p.id}${p.held_out ? " (held out)" : ""}`,
    withUnit(p.quantity.replace(/_(mm|m_s)$/, "").replaceAll("_", " "), p.unit),
    figure(p.impact_velocity_m_s),
    figure(p.measured),
    figure(p.before),
    figure(p.best),
    ...(sampled ? [p.predictive_band ? `${number(p.predictive_band[0])} … ${number(p.predictive_band[1])}` : "–"] : []),
  ]);
  const head = ["value", "quantity", "impact velocity (m/s)", "measured", "before calibration", "calibrated", ...(sampled ? ["95 % interval"] : [])];
  return make("details", { open: "" }, make("summary", {}, "Measured and predicted values"), table(head, lines, [1]));
}

// Gives a case without measured values an example of them.
async function prepare(page: Page): Promise<string | null> {
  if (page.hasMeasured()) return null;
  for (let isIn = false; !isIn;) {
    await page.settled();
    const asked = page.request();
    const done = await post<{ case: string }>("/api/calibration-example", asked);
    isIn = await page.insert(done.case, asked.case);
  }
  return "The case had no measured values: an example is now at the end of its text, computed numbers that were changed. Replace them by your own, then press Calibrate. Undo removes them.";
}
