// Variants of a case side by side, and the way back to the case before a change.

import { button, get, make, table } from "./dom";
import type { Answer, Values } from "./types";

// A case as it stood.
export interface Kept { name: string; case: string; model: string | null }

interface Variant extends Kept {
  answered: string;
  values: Values;
  numbers: Map<string, string>;
}

// Numbers of the model that stand in the table.
const ROWS = ["outcome", "depth of penetration", "residual velocity", "final projectile length", "peak force"];
// Cases to go back to.
const MOST = 100;

export class History {
  private past: Kept[] = [];
  private shown: Kept | null = null;
  private button = get<HTMLButtonElement>("undo");

  constructor(private load: (kept: Kept) => void) {
    this.button.addEventListener("click", () => this.undo());
  }

  // The case of an answer or a refusal.
  add(kept: Kept): void {
    const before = this.shown;
    this.shown = kept;
    if (!before || (before.case === kept.case && before.model === kept.model)) return;
    this.past = [...this.past.slice(1 - MOST), before];
    this.button.disabled = false;
  }

  private undo(): void {
    const last = this.past.pop();
    this.button.disabled = this.past.length === 0;
    if (!last) return;
    // What is left is not a step to come back to.
    this.shown = null;
    this.load(last);
  }
}

export class Variants {
  private kept: Variant[] = [];
  private box = get("variants");
  private answer: Answer | null = null;

  constructor(private name: () => string, private model: () => string | null, private best: () => [string, string] | null, private load: (kept: Kept) => void) {
    get("keep").addEventListener("click", () => this.keep());
  }

  follow(answer: Answer): void {
    this.answer = answer;
  }

  // The axisymmetric answer has a further mesh: variants of this case get it.
  refine(): void {
    const best = this.best();
    const same = this.kept.filter((variant) => best && variant.case === this.answer?.case);
    for (const variant of same) variant.numbers.set(...(best as [string, string]));
    if (same.length) this.show();
  }

  private keep(): void {
    const answer = this.answer;
    if (!answer) return;
    const rows = answer.rows[0].filter(([label]) => ROWS.includes(label));
    const best = this.best();
    const numbers = new Map<string, string>([...(best ? [best] : []), ...rows.map(([label, value]) => [`${label}`, value] as [string, string])]);
    this.kept.push({ name: this.name(), case: answer.case, model: this.model(), answered: answer.model, values: answer.values, numbers });
    this.show();
    this.box.scrollIntoView({ block: "nearest" });
  }

  private show(): void {
    this.box.hidden = this.kept.length === 0;
    const first = this.kept[0];
    if (!first) return this.box.lastElementChild?.replaceChildren();
    const said = (variant: Variant, key: string) => JSON.stringify(variant.values[key] ?? null);
    const keys = [...new Set(this.kept.flatMap((variant) => Object.keys(variant.values)))];
    const changed = keys.filter((key) => this.kept.some((variant) => said(variant, key) !== said(first, key)));
    const labels = [...new Set(this.kept.flatMap((variant) => [...variant.numbers.keys()]))];
    const axisymmetric = labels.filter((label) => !ROWS.includes(label));
    const order = [...axisymmetric, ...ROWS.filter((label) => labels.includes(label))];
    const rows = this.kept.map((variant, i) => [
      `${i + 1}: ${variant.name || "case"}, ${variant.answered}`,
      ...changed.map((key) => words(variant.values[key])),
      ...order.map((label) => variant.numbers.get(label) ?? "–"),
      make("span", {}, this.action("Show", i, () => this.load(variant)), " ", this.action("Remove", i, () => this.remove(i))),
    ]);
    this.box.lastElementChild?.replaceChildren(table(["variant", ...changed, ...order, ""], rows));
  }

  private action(text: string, index: number, act: () => void): HTMLButtonElement {
    const made = button(text, act);
    made.setAttribute("aria-label", `${text} variant ${index + 1}`);
    return made;
  }

  private remove(index: number): void {
    this.kept.splice(index, 1);
    this.show();
  }
}

function words(value: Values[string] | undefined): string {
  if (value === undefined || value === null) return "–";
  return typeof value === "object" ? JSON.stringify(value) : String(value);
}
