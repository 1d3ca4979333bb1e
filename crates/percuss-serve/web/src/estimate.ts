// Card of the axisymmetric answer: its number with the uncertainty, how that shrinks from mesh to mesh, and the one-dimensional number.

import { bring, get, make, micro, pairs, significant } from "./dom";
import { rows } from "./rows";
import type { Answer, Plan, Problem, Refined, RowChart } from "./types";

type Beside = Pick<Answer, "model" | "results">;

// Room beside the outermost values, as a part of their range.
const ROOM = 0.06;
const DIGITS = 3;

export class Estimate {
  readonly element: HTMLElement;
  private headline = make("dl", { class: "headline", "aria-live": "polite" });
  private chart = make("div");
  private details = make("dl");
  private more = make("details", {}, make("summary", {}, "Meshes and limit"), this.details);
  private link = make("a", { href: "#warnings" });
  private warned = make("p", { class: "warned" });
  private words = make("p", { class: "note", role: "status" });
  private bar = make("progress", { max: "1", value: "0", "aria-label": "Progress: axisymmetric answer" });
  private progressWords = make("span", { class: "soft" });
  private running = make("div", { class: "running" }, this.bar, this.progressWords);
  private plan: Plan | null = null;
  private stages: Refined[] = [];
  private beside: Beside | null = null;

  constructor() {
    const title = make("h2", { id: "refined-title" }, "Axisymmetric answer");
    this.element = make("section", { id: "refined", "aria-labelledby": "refined-title" }, title, this.headline, this.warned, this.words, this.running, this.chart, this.more);
    this.warned.hidden = true;
    this.link.addEventListener("click", (event) => {
      // The address holds the case: it stays.
      event.preventDefault();
      const box = get<HTMLDetailsElement>("warnings");
      box.open = true;
      bring(box);
      box.querySelector("summary")?.focus({ preventScroll: true });
    });
    this.idle();
  }

  // Warnings of the run of a model, which stand further below.
  warn(count: string | null, model: string): void {
    this.warned.hidden = count === null;
    this.link.textContent = count;
    this.warned.replaceChildren(this.link, ` of the run by ${model}`);
  }

  begin(plan: Plan): void {
    this.plan = plan;
    this.stages = [];
    this.progress(plan.cells[0] ?? 0, 0);
  }

  progress(cells: number, fraction: number): void {
    this.running.hidden = false;
    this.bar.value = fraction;
    this.progressWords.textContent = `${cells} cells per radius`;
  }

  // The answer after one more mesh.
  add(stage: Refined): void {
    this.element.classList.remove("stale");
    this.stages.push(stage);
    this.show();
  }

  // The result of the one-dimensional model that stands beside it.
  follow(beside: Beside): void {
    this.beside = beside;
    if (this.stages.length && !this.element.classList.contains("stale")) this.show();
  }

  // The case has changed: the numbers of the last one stay, in pale colours.
  fade(): void {
    this.idle();
    this.element.classList.toggle("stale", this.stages.length > 0);
  }

  // Name and number of the answer so far; null without one of this case.
  get answer(): [string, string] | null {
    const isStale = this.element.classList.contains("stale");
    return isStale ? null : (this.stages.at(-1)?.headline ?? null);
  }

  idle(): void {
    this.running.hidden = true;
    this.more.hidden = this.stages.length === 0;
  }

  none(reason: string, remedy: string | null): void {
    this.stages = [];
    this.element.classList.remove("stale");
    this.headline.replaceChildren();
    this.chart.replaceChildren();
    this.words.textContent = micro(`No axisymmetric answer: ${reason}${remedy ? `; ${remedy}` : ""}.`);
    this.idle();
  }

  // What ended the runs; false where there is no number of this case.
  problem({ message, help }: Problem): boolean {
    const has = this.stages.length > 0 && !this.element.classList.contains("stale");
    if (!has) this.none(message, help || null);
    else this.words.textContent = micro(`${message}${help ? `; ${help}` : ""}.`);
    this.idle();
    return has;
  }

  private show(): void {
    const last = this.stages.at(-1);
    if (!last) return;
    const on = (count: number) => (count === 1 ? "first mesh" : `${count} meshes`);
    const first = last.meshes.at(-1)?.[1];
    const name = last.headline?.[0].replace("Axisymmetric ", "") ?? last.quantity.replaceAll("_", " ").replace(/ (mm|m s)$/, "");
    const number = last.headline?.[1] ?? (first == null ? "none" : `${significant(first, DIGITS)} ${last.unit}`);
    const own = this.own(last);
    const shown: [string, string][] = [[`${name}, ${on(last.meshes.length)}`, number]];
    if (own) shown.push([`one-dimensional (${own.model})`, own.words]);
    this.headline.replaceChildren(...pairs(shown));
    const limit = last.rows.find(([label]) => label === "limit")?.[1] ?? "";
    this.words.textContent = micro([last.uncertainty === null ? limit : "", last.note ?? ""].filter(Boolean).join("; "));
    this.details.replaceChildren(...pairs(last.rows));
    this.more.hidden = last.rows.length === 0;
    this.chart.replaceChildren(...this.history(own?.value ?? null));
    this.element.dataset["meshes"] = String(last.meshes.length);
    this.element.dataset["uncertainty"] = String(last.uncertainty);
  }

  private own(last: Refined): { model: string; value: number; words: string } | null {
    const value = this.beside?.results.results[0]?.[last.quantity];
    if (typeof value !== "number" || !this.beside) return null;
    const off = last.value ? 100 * (value / last.value - 1) : null;
    const difference = off === null ? "" : `, ${off > 0 ? "+" : "−"}${Math.abs(off).toFixed(0)} %`;
    return { model: this.beside.model, value, words: `${significant(value, DIGITS)} ${last.unit}${difference}` };
  }

  // The number after each mesh with its uncertainty.
  private history(own: number | null): HTMLElement[] {
    const last = this.stages.at(-1);
    if (!last || !this.plan) return [];
    const { axisymmetric, beside } = this.plan.colors;
    const list: RowChart["rows"] = this.stages.flatMap((stage) => {
      if (stage.quantity !== last.quantity) return [];
      const value = stage.value ?? stage.meshes.at(-1)?.[1];
      if (value == null) return [];
      const name = `${stage.cells} cells`;
      const range: [number, number] | null = stage.uncertainty === null ? null : [value - stage.uncertainty, value + stage.uncertainty];
      const words = stage.headline?.[1].replace(` ${last.unit}`, "") ?? significant(value, DIGITS);
      return [{ name, color: axisymmetric, value, range, words }];
    });
    if (own !== null) list.push({ name: this.beside?.model ?? "", color: beside, value: own, range: null, words: significant(own, DIGITS) });
    const ends = list.flatMap((row) => row.range ?? [row.value]);
    if (ends.length === 0) return [];
    const [low, high] = [Math.min(...ends), Math.max(...ends)];
    const room = ROOM * (high - low || Math.abs(high) || 1);
    const axis = { log: false, downward: false };
    return [rows({
      kind: "rows", name: "refinement", title: "", caption: "", rows: list, marks: [],
      x: { ...axis, label: last.unit, range: [low - room, high + room] },
      y: { ...axis, label: "", range: null },
    })];
  }
}
