// Results of studies as tables.

import { figure, make, significant, table, withUnit } from "./dom";
import type { Comparison, Convergence, Limits, Result } from "./types";

const value = (result: Result, key: string) => {
  const found = result[key];
  return typeof found === "number" ? found : null;
};

// Models at one impact velocity, measured values, and reasons of missing results.
export function comparison(study: Comparison): HTMLElement[] {
  const { results, recommended } = study.comparison;
  const given = results.filter((result) => result.outcome !== "not_applicable" && result.outcome !== "failed");
  const chosen = new Map(recommended[0]?.models.map((choice) => [choice.model, choice.because]));
  const head = ["model", ...study.quantities.flatMap((q) => [withUnit(q.words, q.unit), ...(q.measured === null ? [] : ["difference (%)"])])];
  // The source that the example of the study Calibrate has.
  const isExample = study.comparison.experiments.some(({ sources }) => sources.includes("example"));
  const lines = given.map((result) => [
    chosen.has(result.model) ? `${result.model} ★` : result.model,
    ...study.quantities.flatMap((quantity) => {
      const found = value(result, quantity.key);
      const off = found === null || !quantity.measured ? null : 100 * (found / quantity.measured - 1);
      return [figure(found), ...(quantity.measured === null ? [] : [off === null ? "–" : `${off > 0 ? "+" : ""}${significant(off)}`])];
    }),
  ]);
  if (study.quantities.some((quantity) => quantity.measured !== null)) {
    lines.push([isExample ? "example, no experiment" : "experiment", ...study.quantities.flatMap((q) => [figure(q.measured), ...(q.measured === null ? [] : [""])])]);
  }
  const said = [make("p", {}, make("b", {}, "Regime: "), study.regimes[0] ?? "")];
  for (const [model, because] of chosen) said.push(make("p", {}, make("b", {}, `Recommended: ${model} ★ `), because));
  const note = recommended[0]?.note;
  if (note) said.push(make("p", {}, note));
  if (isExample) said.push(make("p", {}, "What the charts show as experiments are values of the example that Calibrate has put into the case, and no measurements."));
  const absent = results.filter((result) => !given.includes(result));
  const reasons = make("details", {}, make("summary", {}, `${absent.length} models do not apply`),
    make("ul", {}, ...absent.map((result) => make("li", {}, make("b", {}, `${result.model}: `), result.reason ?? ""))));
  const cautions = given.filter((result) => result.warnings.length > 0);
  const warned = make("details", {}, make("summary", {}, `Warnings of ${cautions.length} models`),
    make("ul", {}, ...cautions.flatMap((result) => result.warnings.map((words) => make("li", {}, make("b", {}, `${result.model}: `), words)))));
  return [...said, table(head, lines), ...(absent.length ? [reasons] : []), ...(cautions.length ? [warned] : [])];
}

export function convergence({ study, words }: Convergence): HTMLElement[] {
  const head = ["elements", "steps", ...study.quantities.map((q) => withUnit(q.name.replaceAll("_", " "), q.unit))];
  const lines: (string | Node)[][] = study.meshes.map((mesh, i) => [
    `${mesh.projectile_elements}–${mesh.target_elements}`,
    String(mesh.steps),
    ...study.quantities.map((quantity) => figure(quantity.values[i])),
  ]);
  const statuses: [string, (v: Convergence["study"]["quantities"][number]["status"]) => string | Node][] = [
    ["order", (v) => figure(v.order)],
    ["Richardson", (v) => figure(v.richardson)],
    ["GCI (%)", (v) => figure(v.index === undefined ? null : 100 * v.index)],
  ];
  for (const [name, read] of statuses) lines.push([name, "", ...study.quantities.map((quantity) => read(quantity.status))]);
  const said = study.quantities.map((quantity, i) =>
    make("li", {}, make("b", {}, `${quantity.name.replaceAll("_", " ")}: `), words[i] ?? ""));
  return [table(head, lines), make("ul", {}, ...said)];
}

export function limits(study: Limits): HTMLElement[] {
  const { results, recommended, note, range, axisymmetric } = study.limits;
  const chosen = new Map(recommended.map((choice) => [choice.model, choice.because]));
  const found = results.filter((limit) => limit.outcome === "found");
  const lines = found.map((limit) => [
    chosen.has(limit.model) ? `${limit.model} ★` : limit.model,
    figure(limit.ballistic_limit_m_s),
    limit.bracket ? `${significant(limit.bracket.stopped_m_s, 5)} … ${significant(limit.bracket.perforated_m_s, 5)}` : "–",
    String(limit.runs),
  ]);
  if (axisymmetric?.ballistic_limit_m_s != null) {
    const error = axisymmetric.uncertainty_m_s;
    const value = significant(axisymmetric.ballistic_limit_m_s);
    lines.push([chosen.has("axi") ? "axi ★" : "axi", error == null ? value : `${value} ± ${significant(error, 2)}`, "–", String(axisymmetric.meshes.reduce((sum, mesh) => sum + mesh.runs, 0))]);
  }
  if (study.measured !== null) lines.push(["experiment", figure(study.measured), "", ""]);
  const said: HTMLElement[] = [];
  if (study.freed) {
    said.push(make("h3", {}, "Ballistic limit with a free rear face"));
    said.push(make("p", {}, "The case fixes the rear face, so that nothing can leave the target. `target.back_face = \"free\"` gives these numbers on the command line."));
  }
  if (study.headline) said.push(make("p", {}, make("b", {}, study.headline)));
  if (study.axisymmetric && !chosen.has("axi")) said.push(make("p", {}, `Axisymmetric limit ${study.axisymmetric}`));
  // One reason for all models stands below.
  if (axisymmetric?.reason && axisymmetric.reason !== study.rear_face) said.push(make("p", {}, `No axisymmetric limit: ${axisymmetric.reason}`));
  for (const warning of axisymmetric?.warnings ?? []) said.push(make("p", {}, `axi: ${warning}`));
  if (study.rear_face) said.push(make("p", {}, study.rear_face));
  for (const [model, because] of chosen) said.push(make("p", {}, make("b", {}, `Recommended: ${model} ★ `), because));
  if (note) said.push(make("p", {}, note));
  if (range && range.models > 1) {
    said.push(make("p", {}, `Range of ${range.models} models: ${significant(range.lowest_m_s)} to ${significant(range.highest_m_s)} m/s`));
  }
  const errors = results.flatMap((limit, i) =>
    study.expected[i] ? [make("li", {}, make("b", {}, `estimated model error of ${limit.model}: `), study.expected[i])] : []);
  const rest = results.flatMap((limit, i) =>
    limit.outcome === "found" ? [] : [make("li", {}, make("b", {}, `${limit.model}: `), limit.reason ?? study.outcomes[i] ?? "")]);
  const answer = found.length
    ? table(["model", "ballistic limit (m/s)", "highest partial … lowest complete penetration (m/s)", "runs"], lines)
    : make("p", {}, "No model finds a limit between 0 and 2000 m/s.");
  return [
    ...said,
    answer,
    ...(errors.length ? [make("ul", {}, ...errors)] : []),
    make("details", {}, make("summary", {}, `${rest.length} models without a limit`), make("ul", {}, ...rest)),
  ];
}
