// A study: started by a button, with progress, ended by another, and what it came to.

import { Refused, follow } from "./api";
import { ChartView } from "./charts";
import { button, download, make } from "./dom";
import { explained } from "./problem";
import type { Chart, Problem, Study } from "./types";

// What studies ask of the page.
export interface Page {
  request(): { name: string; case: string; model: string };
  // Calls back after each answer to another case.
  onChange(tell: () => void): void;
  hasUncertainty(): boolean;
  hasMeasured(): boolean;
  // Done when no answer is computed any more.
  settled(): Promise<void>;
  // Another text of the case in place of one; done when its answer is shown. False where the case has changed meanwhile.
  insert(text: string, instead: string): Promise<boolean>;
  // Loads a ready case; done when its answer is shown.
  example(name: string): Promise<void>;
}

export interface Kind {
  title: string;
  about: string;
  path: string;
  // What stands beside the button, and below it.
  inputs?: HTMLElement[];
  below?: HTMLElement;
  body(): object;
  // Whether it takes every model, whichever is chosen.
  ofAllModels?: boolean;
  // The view of a chart takes part in what happens to all charts.
  show(done: unknown, view: (chart: Chart, files: Study["files"]) => ChartView): HTMLElement[];
  // Completes the case before the study; what it has added, in words.
  prepare?(): Promise<string | null>;
  // A ready case for which the study has a result.
  example?: Example;
}

interface Example {
  name: string;
  about: string;
  // Whether the study, or its refusal, came to nothing because the case lacks something.
  suits(done: unknown): boolean;
  refusal: RegExp;
  // After the case is loaded.
  loaded?(): void;
}

export type Views = ChartView[];

export const options = (...choices: [string, string][]) => choices.map(([value, words]) => make("option", { value }, words));

// A control with its name beside it. The name is given again: the choices of a list would count as part of it.
export function labelled<T extends HTMLElement>(words: string, input: T): HTMLElement {
  input.setAttribute("aria-label", words);
  return make("label", {}, `${words} `, input);
}

const unexpected = (error: unknown): Problem => ({ message: String(error), help: "", key: "", place: null });

// A number among the settings of a study that it does not take, marked and under the cursor.
function amiss(settings: HTMLElement): Problem | null {
  let found: HTMLInputElement | null = null;
  for (const input of settings.querySelectorAll<HTMLInputElement>("input[type=number]")) {
    const isWrong = input.value === "" || !input.checkValidity();
    input.removeAttribute("aria-invalid");
    if (!isWrong || input.closest("[hidden]")) continue;
    input.setAttribute("aria-invalid", "true");
    found ??= input;
  }
  if (!found) return null;
  found.focus();
  const name = found.getAttribute("aria-label") ?? found.labels?.[0]?.textContent?.trim() ?? "number";
  const kind = found.step === "1" ? "whole numbers" : "numbers";
  const value = found.value === "" ? "no number" : found.value;
  return { message: `${name}: ${value}`, help: `allowed: ${kind} from ${found.min} to ${found.max}`, key: "", place: null };
}

export function panel(kind: Kind, views: Views, page: Page): HTMLElement {
  const bar = make("progress", { max: "1", value: "0", "aria-label": `Progress: ${kind.title}` });
  const words = make("span", { class: "soft" });
  const result = make("div", { class: "result" });
  let control: AbortController | null = null;
  // Case of the result, with the model where it is of one.
  let studied = "";
  let name = "";
  const asked = () => JSON.stringify({ ...page.request(), ...(kind.ofAllModels ? { model: null } : {}) });
  page.onChange(() => result.classList.toggle("stale", studied !== "" && studied !== asked()));
  const start = button(kind.title, () => void run());
  const cancel = button("Cancel", () => control?.abort());
  const running = make("span", { class: "running", role: "status" }, bar, words, cancel);
  running.hidden = true;

  async function run(): Promise<void> {
    const wrong = amiss(head);
    if (wrong) {
      result.replaceChildren(make("div", { class: "problem", role: "alert" }, ...explained(wrong)));
      return;
    }
    control?.abort();
    const own = (control = new AbortController());
    running.hidden = false;
    start.disabled = true;
    bar.value = 0;
    words.textContent = "";
    result.replaceChildren();
    result.classList.remove("stale");
    try {
      const added = await kind.prepare?.();
      studied = asked();
      name = page.request().name;
      const note = added ? [make("p", { class: "note", role: "status" }, added)] : [];
      const done = await follow<Study>(kind.path, kind.body(), own.signal, (fraction, said) => {
        bar.value = fraction;
        words.textContent = said;
      });
      result.replaceChildren(...note, ...kind.show(done, view), ...(kind.example?.suits(done) ? [offer(kind.example)] : []), ...outcome(done));
    } catch (error) {
      if (own.signal.aborted) {
        result.replaceChildren(make("p", { class: "note" }, "cancelled"));
        return;
      }
      const problem = error instanceof Refused ? error.problem : unexpected(error);
      const more = kind.example?.refusal.test(problem.message) ? offer(kind.example) : null;
      result.replaceChildren(make("div", { class: "problem", role: "alert" }, ...explained(problem)), more ?? "");
    } finally {
      running.hidden = true;
      start.disabled = false;
    }
  }

  // Loads the ready case and starts the study again.
  function offer(example: Example): HTMLElement {
    const load = button(`Use the example ${example.name}`, () => {
      load.disabled = true;
      void page.example(example.name).then(() => {
        example.loaded?.();
        return run();
      });
    });
    return make("p", { class: "note" }, load, ` ${example.about} It replaces the case of the page; Undo brings that back.`);
  }

  // Files that name each other keep their names; others are told apart by the case.
  const save = (file: string, text: string) => download(file.endsWith(".toml") ? file : `${name || "case"}-${file}`, text, "text/plain");

  function figureButton(chart: { name: string; title: string }, files: Study["files"]): HTMLElement[] {
    const name = `${chart.name}.svg`;
    const text = files[name];
    if (text === undefined) return [];
    const action = button("SVG", () => save(name, text));
    action.setAttribute("aria-label", `SVG of the figure: ${chart.title}`);
    return [action];
  }

  function view(chart: Chart, files: Study["files"]): ChartView {
    const made = new ChartView(figureButton(chart, files));
    views.push(made);
    queueMicrotask(() => made.show(chart));
    return made;
  }

  // Charts, pictures and files that every study has.
  function outcome(study: Study): HTMLElement[] {
    const files = study.files ?? {};
    const charts = study.charts.map((chart) => view(chart, files).element);
    const pictures = (study.pictures ?? []).map(({ name, title, svg }) => {
      const actions = make("span", { class: "actions" }, ...figureButton({ name, title }, { [`${name}.svg`]: svg }));
      const image = make("img", { src: `data:image/svg+xml,${encodeURIComponent(svg)}`, alt: title });
      // The picture has its title in it.
      return make("figure", { "data-chart": name }, make("div", { class: "head" }, make("span"), actions), image);
    });
    const buttons = Object.entries(files).filter(([name]) => !name.endsWith(".svg")).map(([name, text]) => button(name, () => save(name, text)));
    return [
      make("div", { class: "charts" }, ...charts, ...pictures),
      ...(buttons.length ? [make("p", { class: "files" }, "Download: ", ...buttons)] : []),
    ];
  }

  const head = make("div", { class: "bar" }, start, make("span", { class: "soft" }, kind.about), ...(kind.inputs ?? []), running);
  return make("div", { class: "study" }, head, kind.below ?? null, result);
}
