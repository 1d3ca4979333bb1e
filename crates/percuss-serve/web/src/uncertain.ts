// Results of an uncertainty analysis, and an example of its inputs.

import { post } from "./api";
import { figure, make, significant, table, withUnit } from "./dom";
import { options, type Kind, type Page } from "./panel";
import type { Spread } from "./types";

const percent = (part: number) => significant(Math.round(1000 * part) / 10);
const list = (items: string[]) => make("ul", {}, ...items.map((words) => make("li", {}, words)));

export function uncertainty(page: Page): Kind {
  const samples = make("select", {}, ...options(...["64", "256", "1024", "4096"].map((count): [string, string] => [count, count])));
  samples.value = "256";
  const seed = make("input", { type: "number", min: "0", max: "9007199254740991", step: "1", value: "0" });
  const indices = make("input", { type: "checkbox", checked: "" });
  return {
    title: "Uncertainty",
    about: "propagation of uncertain input parameters to the results",
    path: "/api/study/uncertainty",
    inputs: [make("label", {}, "samples ", samples), make("label", {}, "seed ", seed), make("label", {}, indices, " Sobol' indices")],
    body: () => ({
      ...page.request(),
      uncertainty: { samples: Number(samples.value), seed: Number(seed.value), indices: indices.checked },
    }),
    show: (done) => spread(done as Spread),
    prepare: () => prepare(page),
  };
}

function spread(done: Spread): HTMLElement[] {
  const found = done.uncertainty;
  const perforation = found.perforation;
  const failed = found.failures.runs;
  const said = [
    `Model ${found.model}, ${found.samples} samples, seed ${found.seed}, ${found.runs} runs in total. Outcome at median inputs: ${done.nominal}.`,
    perforation ? `Probability of perforation: ${percent(perforation.probability)} % (${percent(perforation.low)} … ${percent(perforation.high)} %), ${perforation.perforated} of ${perforation.perforated + perforation.stopped} runs.` : "",
    failed ? `${failed} of ${found.samples} runs have no result.` : "",
  ];
  const inputs = found.inputs.map((input, i) => [done.labels[i] ?? input.key, input.distribution]);
  const warnings = [...found.warnings, ...found.nominal.warnings];
  return [
    ...said.filter((words) => words).map((words) => make("p", {}, words)),
    make("div", { class: "side" }, table(["parameter", "distribution"], inputs, [1]), found.quantities.length ? statistics(done) : null),
    ...(found.no_indices ? [make("p", {}, `No Sobol' indices: ${found.no_indices}.`)] : []),
    ...(warnings.length ? [list(warnings)] : []),
    make("p", {}, done.caution),
    ...found.quantities.map((_, i) => influence(done, i)),
  ];
}

// One row per statistic, one column per quantity.
function statistics(done: Spread): HTMLElement {
  const found = done.uncertainty.quantities;
  const at = (q: (typeof found)[number], wanted: number) => q.statistics.percentiles.find((p) => p.percent === wanted)?.value;
  const rows: [string, (q: (typeof found)[number]) => string | Node][] = [
    ["at median inputs", (q) => figure(q.nominal)],
    ["mean", (q) => figure(q.statistics.mean)],
    ["standard error of the mean", (q) => figure(q.statistics.standard_error, 2)],
    ["standard deviation", (q) => figure(q.statistics.standard_deviation)],
    ["5th percentile", (q) => figure(at(q, 5))],
    ["median", (q) => figure(at(q, 50))],
    ["95th percentile", (q) => figure(at(q, 95))],
    ["runs", (q) => String(q.statistics.runs)],
  ];
  const head = ["", ...done.quantities.map((q) => withUnit(q.words, q.unit))];
  return table(head, rows.map(([name, read]) => [name, ...found.map(read)]));
}

// Tornado chart and indices of a quantity as a table.
function influence(done: Spread, place: number): HTMLElement {
  const quantity = done.uncertainty.quantities[place];
  const { words, unit } = done.quantities[place] ?? { words: "", unit: "" };
  const label = (key: string) => done.labels[done.uncertainty.inputs.findIndex((input) => input.key === key)] ?? key;
  const indices = quantity?.indices?.parameters;
  const head = ["parameter", withUnit("at 5th percentile", unit), withUnit("at 95th percentile", unit), ...(indices ? ["first-order index", "total-effect index"] : [])];
  const lines = (quantity?.tornado ?? []).map((bar) => {
    const index = indices?.find((one) => one.key === bar.key);
    const both = index ? [index.first_order, index.total] : [];
    const estimates = both.map((e) => `${e.value.toFixed(2)} (${e.low.toFixed(2)} … ${e.high.toFixed(2)})`);
    return [label(bar.key), figure(bar.at_low), figure(bar.at_high), ...(indices ? (estimates.length ? estimates : ["–", "–"]) : [])];
  });
  const why = !done.uncertainty.no_indices && quantity?.no_indices ? make("p", {}, `No Sobol' indices: ${quantity.no_indices}.`) : null;
  return make("details", {}, make("summary", {}, `Sensitivity of the ${words} as a table`), table(head, lines), why);
}

// Gives a case without uncertain parameters an example of them.
async function prepare(page: Page): Promise<string | null> {
  if (page.hasUncertainty()) return null;
  for (let isIn = false; !isIn;) {
    await page.settled();
    const asked = page.request();
    const done = await post<{ case: string }>("/api/uncertainty-example", asked);
    isIn = await page.insert(done.case, asked.case);
  }
  return "The case had no uncertain parameters: an example is now at the end of its text. Replace the assumed distributions by your own, then press Uncertainty. Undo removes it.";
}
