// Sweep: a case with one or two parameters varied.

import { figure, make, table } from "./dom";
import { labelled, options, type Kind, type Page } from "./panel";
import { Parameters, type Numbers } from "./parameters";
import type { Chart, Swept, Study } from "./types";
import type { ChartView } from "./charts";

export function sweep(page: Page, numbers: Numbers): Kind {
  const parameters = new Parameters({
    title: "sweep",
    steps: true,
    most: 2,
    first: /^projectile\.impact_velocity$/,
    around: [0.8, 1.2],
    head: () => `base = "scenario.toml"\nmodel = ${JSON.stringify(page.request().model)}\ndesign = "grid"\n`,
  }, numbers);
  return {
    title: "Sweep",
    about: "the case with one or two parameters varied",
    path: "/api/study/sweep",
    below: parameters.element,
    body: () => ({ ...page.request(), sweep: parameters.toml() }),
    show: (done, view) => show(done as Swept, view),
  };
}

function show(done: Swept, view: (chart: Chart, files: Study["files"]) => ChartView): HTMLElement[] {
  const outcomes = Object.entries(done.outcomes).map(([outcome, count]) => `${count} ${outcome}`);
  const said: HTMLElement[] = [make("p", {}, `Model ${done.model}, ${done.design}, ${done.runs} runs: ${outcomes.join(", ")}.`)];
  if (done.reasons.length) said.push(make("ul", {}, ...done.reasons.map((reason) => make("li", {}, reason))));
  const rows = make("div");
  if (done.drawn.length === 0) return [...said, rowsTable(done, "")];

  const quantity = make("select", {}, ...options(...done.numbers.map((number): [string, string] => [number.quantity, number.label])));
  const styles = [...new Set(done.drawn.map((drawn) => drawn.style))];
  const style = make("select", {}, ...options(...styles.map((name): [string, string] => [name, name])));
  const place = make("div", { class: "charts" });
  const draw = () => {
    const drawn = done.drawn.find((one) => one.quantity === quantity.value && one.style === style.value);
    place.replaceChildren(...(drawn ? [view(drawn.chart, done.files).element] : []));
    rows.replaceChildren(rowsTable(done, quantity.value));
  };
  for (const select of [quantity, style]) select.addEventListener("input", draw);
  draw();
  const drawnAs = styles.length > 1 ? [labelled("style", style)] : [];
  return [...said, make("div", { class: "bar" }, labelled("quantity", quantity), ...drawnAs), place, rows];
}

// Rows of the sweep as a table.
function rowsTable(done: Swept, quantity: string): HTMLElement {
  const number = done.numbers.find((one) => one.quantity === quantity);
  const head = [...done.parameters.map(({ label }) => label), "outcome", ...(number ? [number.label] : [])];
  const lines = done.rows.map((row, i) => {
    const inputs = row.inputs.map((value, at) => done.parameters[at]?.words[value] ?? figure(value, 4));
    const value = number?.values[i];
    return [...inputs, row.outcome, ...(number ? [figure(value)] : [])];
  });
  const shown = done.rows.length < done.runs ? `The first ${done.rows.length} of ${done.runs} rows` : "The rows";
  return make("details", {}, make("summary", {}, shown), table(head, lines, [done.parameters.length]));
}
