// Studies: started by a button, with progress, and ended by another.

import { Refused, follow } from "./api";
import { ChartView } from "./charts";
import { button, download, make, pairs } from "./dom";
import { comparison, convergence, limits } from "./tables";
import { offer, spread } from "./uncertain";
import type { Answer, Comparison, Convergence, Limits, Spread, Study } from "./types";

interface Kind {
  title: string;
  about: string;
  path: string;
  inputs?: HTMLElement[];
  body(): object;
  show(done: unknown): HTMLElement[];
  // What else to say to a refusal.
  refused?(): HTMLElement | null;
}

// What studies ask of the page.
export interface Case {
  request(): { name: string; case: string; model: string };
  hasUncertainty(): boolean;
  insert(text: string): void;
}

type Views = ChartView[];

// A study with its button, its bar and what it came to.
function panel(kind: Kind, views: Views, named: () => string): HTMLElement {
  const bar = make("progress", { max: "1", value: "0", "aria-label": `Progress: ${kind.title}` });
  const words = make("span", { class: "soft" });
  const result = make("div", { class: "result" });
  let control: AbortController | null = null;
  const start = button(kind.title, () => void run());
  const cancel = button("Cancel", () => control?.abort());
  const running = make("span", { class: "running", role: "status" }, bar, words, cancel);
  running.hidden = true;

  async function run(): Promise<void> {
    control?.abort();
    const own = (control = new AbortController());
    running.hidden = false;
    start.disabled = true;
    bar.value = 0;
    words.textContent = "";
    result.replaceChildren();
    try {
      const done = await follow<unknown>(kind.path, kind.body(), own.signal, (fraction, said) => {
        bar.value = fraction;
        words.textContent = said;
      });
      result.replaceChildren(...kind.show(done), ...outcome(done as Study));
    } catch (error) {
      const said = own.signal.aborted ? "cancelled" : error instanceof Refused ? `${error.problem.message}. ${error.problem.help}` : String(error);
      const more = own.signal.aborted ? null : kind.refused?.();
      result.replaceChildren(make("p", { class: "note" }, said), ...(more ? [more] : []));
    } finally {
      running.hidden = true;
      start.disabled = false;
    }
  }

  // Charts and files that every study has.
  function outcome(study: Study): HTMLElement[] {
    const charts = make("div", { class: "charts" });
    for (const chart of study.charts) {
      const view = new ChartView();
      charts.append(view.element);
      views.push(view);
      queueMicrotask(() => view.show(chart));
    }
    const files = Object.entries(study.files ?? {}).map(([name, text]) =>
      button(name, () => download(`${named()}-${name}`, text, "text/plain")));
    return [charts, ...(files.length ? [make("p", { class: "files" }, "Download: ", ...files)] : [])];
  }

  return make("div", { class: "study" }, make("div", { class: "bar" }, start, ...(kind.inputs ?? []), make("span", { class: "soft" }, kind.about), running), result);
}

function speed(label: string, value: number): [HTMLElement, HTMLInputElement] {
  const input = make("input", { type: "number", min: "0", max: "10000", value: String(value) });
  return [make("label", {}, `${label} `, input), input];
}

function uncertainty(page: Case): Kind {
  const counts = [64, 256, 1024, 4096].map((count) => make("option", { value: String(count) }, String(count)));
  const samples = make("select", {}, ...counts);
  samples.value = "256";
  const seed = make("input", { type: "number", min: "0", max: "9007199254740991", step: "1", value: "0" });
  const indices = make("input", { type: "checkbox", checked: "" });
  return {
    title: "Uncertainty",
    about: "what the uncertain numbers of the case do to its results",
    path: "/api/study/uncertainty",
    inputs: [make("label", {}, "shots ", samples), make("label", {}, "seed ", seed), make("label", {}, indices, " Sobol' indices")],
    body: () => ({
      ...page.request(),
      uncertainty: { samples: Number(samples.value), seed: Number(seed.value), indices: indices.checked },
    }),
    show: (done) => spread(done as Spread),
    refused: () => (page.hasUncertainty() ? null : offer(() => page.request(), (text) => page.insert(text))),
  };
}

// All studies.
export function studies(page: Case, views: Views): HTMLElement[] {
  const asked = () => page.request();
  const named = () => asked().name || "case";
  const [from, fromInput] = speed("from", 100);
  const [to, toInput] = speed("to", 1000);
  const kinds: Kind[] = [
    {
      title: "Models over speeds",
      about: "every model at 25 impact speeds",
      path: "/api/study/compare",
      inputs: [from, to, make("span", {}, "m/s")],
      body: () => ({ ...asked(), model: null, speeds: [Number(fromInput.value), Number(toInput.value), 25] }),
      show: () => [],
    },
    {
      title: "Convergence",
      about: "the model on four meshes, each twice as fine as the last",
      path: "/api/study/converge",
      body: asked,
      show: (done) => convergence(done as Convergence),
    },
    {
      title: "Ballistic limit",
      about: "the speed that perforates the target, by every model that can tell",
      path: "/api/study/limit",
      body: () => ({ ...asked(), model: null }),
      show: (done) => limits(done as Limits),
    },
    uncertainty(page),
    {
      title: "Axisymmetric reference",
      about: "the model axi: two dimensions, by the material point method; takes a while",
      path: "/api/study/run",
      body: () => ({ ...asked(), model: "axi" }),
      show: (done) => (done as Answer).rows.map((rows) => make("dl", {}, ...pairs(rows))),
    },
  ];
  return kinds.map((kind) => panel(kind, views, named));
}

// Every model at the speed of the case, again and again as the case changes.
export class SideBySide {
  private view = new ChartView();
  private control: AbortController | null = null;
  private timer = 0;

  constructor(private body: HTMLElement, views: Views) {
    views.push(this.view);
  }

  follow(request: { name: string; case: string }): void {
    clearTimeout(this.timer);
    this.control?.abort();
    this.timer = window.setTimeout(() => void this.run(request), 300);
  }

  // Nothing of an earlier case stands beside one that has no answer.
  stop(): void {
    clearTimeout(this.timer);
    this.control?.abort();
  }

  private async run(request: { name: string; case: string }): Promise<void> {
    const own = (this.control = new AbortController());
    try {
      const done = await follow<Comparison>("/api/study/compare", request, own.signal, () => undefined);
      const open = new Set(Array.from(this.body.querySelectorAll("details"), (details, i) => (details.open ? i : -1)));
      this.body.replaceChildren(...comparison(done));
      this.body.querySelectorAll("details").forEach((details, i) => (details.open = open.has(i)));
      const chart = done.charts[0];
      if (!chart) return;
      this.body.append(this.view.element);
      this.view.show(chart);
    } catch (error) {
      if (own.signal.aborted) return;
      const said = error instanceof Refused ? `${error.problem.message}. ${error.problem.help}` : String(error);
      this.body.replaceChildren(make("p", { class: "note" }, said));
    }
  }
}
