// The page: the case on the left, its results on the right, updated while a slider moves.

import "uplot/dist/uPlot.min.css";
import "./app.css";
import { Refused, follow, lost, post, postForFile } from "./api";
import { ChartView } from "./charts";
import { onThemeChange } from "./colors";
import { bring, button, download, get, make, pairs } from "./dom";
import { Form, type Edit } from "./form";
import { fromFragment, toFragment } from "./link";
import { Numbers } from "./parameters";
import { explained } from "./problem";
import { Refinement } from "./refinement";
import { report } from "./report";
import { SideBySide } from "./side";
import { studies } from "./studies";
import type { Answer, Problem, Start } from "./types";
import { History, Variants } from "./variants";

// Time without motion after which a slider is at rest [ms].
const REST_MS = 150;
// A longer run is cancelled when the case changes; a shorter one is completed, so that curves follow a slider [ms].
const PATIENCE_MS = 400;

const start = JSON.parse(get("data").textContent ?? "") as Start;
const text = get<HTMLTextAreaElement>("text");
const models = get<HTMLSelectElement>("models");
const cases = get<HTMLSelectElement>("cases");
// Choice of no model.
const automatic = make("option", { value: "" }, "automatic");
const views = new Map<string, ChartView>();
const others: ChartView[] = [];
const form = new Form(start, (edits, moving) => ask(edits, moving));
const numbers = new Numbers(start.fields);
const sideBySide = new SideBySide(get("comparison-body"), others);
const refinement = new Refinement(
  () => name || "case",
  (time, rests) => [...views.values()].forEach((view) => view.mark(time, rests)),
  () => variants.refine(),
);
const variants = new Variants(() => name, () => model, () => refinement.answer, load);
const past = new History(load);
// Studies that are told of another case.
const followers: (() => void)[] = [];

let name = start.name;
// null: the server selects the model.
let model: string | null = null;
// Model of the answer that is shown.
let answered = start.answer.model;
let pending: { edits: Map<string, Edit>; moving: boolean } | null = null;
// Edits that have not reached the server, which did not respond.
let unsent = new Map<string, Edit>();
// Done when no answer is computed any more.
let idle: Promise<void> = Promise.resolve();
let values = start.answer.values;
let rest = 0;
let current: { control: AbortController; since: number } | null = null;
let saved = 0;
// Counts the cases that were loaded: an edit of one is none of another.
let loaded = 0;
// What waits for the next whole answer.
const waiting: (() => void)[] = [];

// Asks for the answer to the case as it stands, with edits of the form. While one is computed the latest wish waits. While a slider
// moves a draft will do: the curves in view, with fewer points.
function ask(edits: Edit[] = [], moving = false): void {
  clearTimeout(rest);
  // What is refined is no longer the answer, and the processor is wanted.
  if (edits.length || !refinement.has(text.value)) refinement.stop();
  pending ??= { edits: unsent, moving };
  unsent = new Map();
  pending.moving &&= moving;
  for (const edit of edits) pending.edits.set(edit.key, edit);
  if (!current) idle = answerAll();
  else if (performance.now() - current.since > PATIENCE_MS) current.control.abort();
}

// Edits that wait for their answer.
const later = () => pending?.edits;

// Puts edits of a run that was ended before those that wait; false when nothing waits.
function keep(edits: Map<string, Edit>): boolean {
  if (!pending) return false;
  pending = { ...pending, edits: new Map([...edits, ...pending.edits]) };
  return true;
}

async function answerAll(): Promise<void> {
  while (pending) {
    const { edits, moving } = pending;
    pending = null;
    const control = new AbortController();
    const since = performance.now();
    current = { control, since };
    const [sent, asked, own] = [text.value, model, loaded];
    const busy = window.setTimeout(() => wait(control), PATIENCE_MS);
    try {
      const seen = [...views].filter(([, view]) => view.inView).map(([chart]) => chart);
      const body = { name, case: sent, edits: [...edits.values()], model, ...(moving ? { in_view: seen } : {}) };
      const answer = await post<Answer>("/api/answer", body, control.signal);
      if (text.value === sent) text.value = answer.case;
      // What the form changed goes into the text that was written meanwhile.
      else if (own === loaded) keep(edits);
      show(answer, since, moving);
      // A model that was chosen meanwhile is computed next.
      if (model !== asked) models.value = model ?? "";
      if (moving && !pending) rest = window.setTimeout(() => ask(), REST_MS);
    } catch (error) {
      if (control.signal.aborted) {
        // What the form had changed is not lost with the run that was ended.
        if (own !== loaded) continue;
        if (!keep(edits)) get("status").textContent = "cancelled";
      } else if (error instanceof Refused) {
        const refused = error.body as { case?: string; values?: Answer["values"] };
        if (refused.case !== undefined && text.value === sent) text.value = refused.case;
        if (refused.values && Object.keys(refused.values).length) form.show(refused.values, model ?? answered, undefined, later());
        if (error.problem === lost && own === loaded) unsent = edits;
        else past.add({ name, case: text.value, model });
        // It may have begun with the answer to an earlier change.
        refinement.stop();
        refuse(error.problem);
      } else {
        throw error;
      }
    } finally {
      clearTimeout(busy);
      current = null;
    }
  }
}

// Shows that a run is in progress, with a button to cancel it.
function wait(control: AbortController): void {
  get("status").replaceChildren("computing … ", button("Cancel", () => control.abort()));
}

// Shows an answer to a wish of a time; the first answer comes with the page. A draft is soon followed by the whole.
function show(answer: Answer, since: number | null, draft: boolean): void {
  get("problem").hidden = true;
  get("answer").classList.remove("stale");
  form.mark("");
  answered = answer.model;
  automatic.textContent = model === null ? `automatic: ${answered}` : "automatic";
  models.value = model ?? "";
  const known = start.cases.find((one) => one.name === name);
  cases.value = known?.text === answer.case ? name : "";
  form.show(answer.values, answer.model, draft ? undefined : answer.in_use, later());
  get("own-title").textContent = `Numbers of model ${answer.model}`;
  get("numbers").replaceChildren(...pairs(answer.rows[0]));
  get("more-numbers").querySelector("dl")?.replaceChildren(...pairs([...answer.rows[1], ...answer.rows[2]]));
  const warnings = answer.results.results[0]?.warnings ?? [];
  const box = get<HTMLDetailsElement>("warnings");
  box.hidden = warnings.length === 0;
  const count = warnings.length === 1 ? "1 warning" : `${warnings.length} warnings`;
  box.querySelector("summary")!.textContent = count;
  refinement.warn(warnings.length ? count : null, answer.model);
  box.querySelector("ul")!.replaceChildren(...warnings.map((words) => make("li", {}, words)));
  values = answer.values;
  if (draft) for (const chart of answer.charts) views.get(chart.name)?.show(chart);
  else showCharts(answer);
  const run = `${answer.elapsed_ms.toFixed(0)} ms`;
  const took = since === null ? "" : `${(performance.now() - since).toFixed(0)} ms from change to curves, ${run} of them for the run`;
  get("status").textContent = took || `computed in ${run}`;
  document.documentElement.dataset["answers"] = String(Number(document.documentElement.dataset["answers"] ?? 0) + 1);
  if (draft) return;
  past.add({ name, case: answer.case, model });
  variants.follow(answer);
  numbers.follow(answer);
  for (const done of waiting.splice(0)) done();
  sideBySide.follow({ name, case: answer.case });
  refinement.follow({ name, case: answer.case }, answer);
  for (const tell of followers) tell();
  downloads(answer);
  saveSoon();
}

function showCharts(answer: Answer): void {
  const charts = answer.charts.map((chart) => {
    let view = views.get(chart.name);
    if (!view) {
      const file = `${chart.name}.svg`;
      const action = button("SVG", () => void take(file));
      action.setAttribute("aria-label", `SVG of the figure: ${chart.title}`);
      view = new ChartView([action]);
      views.set(chart.name, view);
    }
    return { chart, view };
  });
  // The first one stands beside the numbers, where it is seen to follow a slider.
  const [first, ...further] = charts.map(({ view }) => view.element);
  place(get("seen"), first ? [refinement.impact.element, first] : [refinement.impact.element]);
  place(get("charts"), further);
  for (const { chart, view } of charts) view.show(chart);
}

// Puts elements into a box, unless they are there.
function place(box: HTMLElement, elements: HTMLElement[]): void {
  if (elements.length !== box.children.length || elements.some((element, i) => element !== box.children[i])) box.replaceChildren(...elements);
}

function refuse(problem: Problem): void {
  const box = get("problem");
  box.replaceChildren(...explained(problem), ...(problem === lost ? [button("Try again", () => ask())] : []));
  box.hidden = false;
  form.mark(problem.key);
  get("answer").classList.add("stale");
  get("status").textContent = "the results are those of the last valid case";
  sideBySide.stop();
  saveSoon();
}

// What is being written is saved when it rests, a refused case too.
function saveSoon(): void {
  clearTimeout(saved);
  saved = window.setTimeout(() => void save(), 400);
}

// Keeps the case as it stands in the address of the page.
async function save(): Promise<void> {
  const fragment = await toFragment({ name, case: text.value, model });
  if (fragment !== location.hash) history.replaceState(null, "", fragment);
}

// Copies the address of the case as it stands, a refused one too.
async function copyLink(): Promise<void> {
  await idle;
  clearTimeout(saved);
  await save();
  try {
    await navigator.clipboard.writeText(location.href);
    get("status").textContent = "the link is in the clipboard";
  } catch {
    get("status").textContent = "the link is the address of this page";
  }
}

async function take(file: string): Promise<void> {
  try {
    const content = await postForFile("/api/file", { name, case: text.value, model: model ?? answered, file });
    download(`${name || "case"}-${file}`, content, content.type);
  } catch (error) {
    if (error instanceof Refused) refuse(error.problem);
  }
}

async function takeReport(answer: Answer): Promise<void> {
  const best = refinement.answer;
  const impact = refinement.impact.still();
  try {
    const figures = await Promise.all(answer.charts.map(async ({ name: chart, title }) => {
      const content = await postForFile("/api/file", { name, case: answer.case, model: answer.model, file: `${chart}.svg` });
      return { title, svg: await content.text() };
    }));
    download(`${name || "case"}-report.html`, report({ name, answer, best, impact, figures }), "text/html");
  } catch (error) {
    if (error instanceof Refused) refuse(error.problem);
  }
}

function downloads(answer: Answer): void {
  const history = answer.charts.length ? ["history.csv", "final-profile.csv", "history.parquet", "profiles.parquet"] : [];
  const figures = answer.charts.map((chart) => `${chart.name}.svg`);
  const whole = button("scenario.toml", () => download("scenario.toml", text.value, "application/toml"));
  const all = button("report.html", () => void takeReport(answer));
  get("downloads").replaceChildren(whole, all, ...["result.json", ...history, ...figures].map((file) => button(file, () => void take(file))));
}

function load(state: { name: string; case: string; model: string | null }): void {
  loaded++;
  [pending, unsent] = [null, new Map()];
  name = state.name;
  model = state.model;
  text.value = state.case;
  cases.value = start.cases.some((known) => known.name === name) ? name : "";
  ask();
}

async function validate(): Promise<void> {
  const control = new AbortController();
  const trigger = get<HTMLButtonElement>("validation");
  trigger.disabled = true;
  const say = (words: string) => (get("status").textContent = words);
  try {
    const done = await follow<{ address: string }>("/api/validation", {}, control.signal, (fraction, words) =>
      say(`validation: ${words || "published tests"}, ${Math.round(100 * fraction)} %`));
    say("");
    // In place of the button: the report stays as long as the server.
    const link = make("a", { href: done.address, target: "_blank", rel: "noopener" }, "Open the validation report");
    trigger.replaceWith(link);
    link.focus();
  } catch (error) {
    if (!(error instanceof Refused)) throw error;
    say(`validation: ${error.problem.message}; ${error.problem.help}`);
  } finally {
    trigger.disabled = false;
  }
}

function build(): void {
  cases.append(make("option", { value: "", disabled: "" }, "your own"));
  cases.append(...start.cases.map((known) => make("option", { value: known.name, title: known.title }, known.name)));
  cases.value = start.cases.some((known) => known.name === name) ? name : "";
  cases.addEventListener("input", () => {
    const chosen = start.cases.find((known) => known.name === cases.value);
    if (chosen) load({ name: chosen.name, case: chosen.text, model: null });
  });
  models.append(automatic, ...start.models.filter((known) => !known.slow).map((known) => make("option", { value: known.name, title: known.summary }, known.name)));
  models.addEventListener("input", () => {
    model = models.value || null;
    ask();
  });
  text.addEventListener("input", () => ask());
  // Edits that the server has not got stand in the form alone.
  addEventListener("beforeunload", (event) => unsent.size && event.preventDefault());
  get("to-studies").addEventListener("click", () => bring(get("studies-title")));
  get("validation").addEventListener("click", () => void validate());
  get("link").addEventListener("click", () => void copyLink());
  const page = {
    request: () => ({ name, case: text.value, model: model ?? answered }),
    onChange: (tell: () => void) => void followers.push(tell),
    hasMeasured: () => Object.keys(values).some((key) => /^(experiments|measured_curves)\./.test(key)),
    hasUncertainty: () => Object.keys(values).some((key) => key.startsWith("uncertainty.")),
    settled: () => idle,
    insert: async (example: string, asked: string) => {
      if (text.value !== asked) return false;
      text.value = example;
      get<HTMLDetailsElement>("text-box").open = true;
      text.scrollTop = text.scrollHeight;
      ask();
      await new Promise<void>((done) => waiting.push(done));
      return true;
    },
    example: (wanted: string) => {
      const known = start.cases.find((one) => one.name === wanted);
      if (known) load({ name: known.name, case: known.text, model: null });
      return new Promise<void>((done) => waiting.push(done));
    },
  };
  get("studies").append(...studies(page, numbers, others));
  // What is printed was not all in view.
  addEventListener("beforeprint", () => [...views.values(), ...others].forEach((view) => view.settle()));
  onThemeChange(() => [...views.values(), ...others, refinement.impact].forEach((view) => view.draw()));
  addEventListener("hashchange", () => void fromFragment(location.hash).then((state) => state && load(state)));
  const menu = get("downloads").closest("details") as HTMLDetailsElement;
  const close = () => (menu.open = false);
  document.addEventListener("keydown", (event) => event.key === "Escape" && close());
  document.addEventListener("click", (event) => {
    const at = event.target as Element;
    if (!menu.contains(at) || at.closest("#downloads button")) close();
  });
}

build();
text.value = start.answer.case;
const linked = fromFragment(location.hash);
show(start.answer, null, false);
void linked.then((state) => state && load(state));
