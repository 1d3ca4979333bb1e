// Numbers of a case with ranges: a row each, or the text of the file that they make.

import { button, make, significant } from "./dom";
import { labelled } from "./panel";
import { expand, layersOf, shown, written } from "./form";
import type { Answer, Field } from "./types";

// Parameter of the case with its present value.
interface CaseNumber { key: string; value: string }

const GROUPS: Record<string, string> = { projectile: "Projectile", target: "Target", materials: "Materials" };
const NUMBER = /^([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*([^\s\d.].*)?$/;

// Parameters of the case for the lists of all studies.
export class Numbers {
  private known: CaseNumber[] = [];
  private followers: (() => void)[] = [];

  constructor(private fields: Field[]) {}

  follow(answer: Answer): void {
    const { values, model, constants } = answer;
    const tables = ["projectile", "target", model.replaceAll("-", "_")];
    const here = this.fields.flatMap((field) => expand(field, layersOf(values))).filter((field) => {
      const number = field.kind === "quantity" || field.kind === "number";
      return number && tables.some((table) => field.key.startsWith(`${table}.`)) && (!field.nested || field.key in values);
    });
    this.known = [...here.map(({ key }) => ({ key, value: shown(values[key]) })), ...constants];
    for (const changed of this.followers) changed();
  }

  onChange(action: () => void): void {
    this.followers.push(action);
  }

  value(key: string): string {
    return this.known.find((number) => number.key === key)?.value ?? "";
  }

  // A number that has a value, one of a kind if there is.
  find(wanted: (key: string) => boolean, kind: RegExp): string {
    const known = this.known.filter(({ key, value }) => wanted(key) && value !== "" && about(value, [1, 1])[0] !== "").map(({ key }) => key);
    return known.find((key) => kind.test(key)) ?? known[0] ?? "";
  }

  // The keys as choices, a group a table; one that is chosen stays among them.
  choices(chosen: string): HTMLElement[] {
    const groups = new Map<string, HTMLElement>();
    const keys = this.known.map((number) => number.key);
    for (const key of keys.includes(chosen) || chosen === "" ? keys : [chosen, ...keys]) {
      const [table = "", ...rest] = key.split(".");
      const title = GROUPS[table] ?? `Model ${table}`;
      const group = groups.get(title) ?? make("optgroup", { label: title });
      groups.set(title, group);
      // What tells constants of a material apart comes first: a list has little room.
      const words = table === "materials" ? rest.reverse().join(", ") : [table, ...rest].join(" ");
      group.append(make("option", { value: key }, inWords(words)));
    }
    return [...groups.values()];
  }
}

// Keys as words: youngs_modulus is Young's modulus.
function inWords(keys: string): string {
  return keys.replaceAll("_", " ").replace("youngs", "Young's").replace("poissons", "Poisson's");
}

// Range around a value; none where the value is not a number.
function about(value: string, parts: [number, number]): [string, string] {
  const [, digits, unit] = NUMBER.exec(value) ?? [];
  if (digits === undefined || Number(digits) === 0) return ["", ""];
  const whole = unit === undefined && /^\d+$/.test(digits);
  const end = (part: number) => (whole ? String(Math.round(part * Number(digits))) : significant(part * Number(digits), 3));
  return parts.map(end).map((text) => (unit ? `${text} ${unit}` : text)) as [string, string];
}

export interface Shape {
  // Name of the list, for its labels.
  title: string;
  // Whether a range has a number of values, at even steps or ratios.
  steps: boolean;
  most: number;
  // The number to begin with, and the parts of its value that its range reaches to.
  first: RegExp;
  around: [number, number];
  // The file around the tables of the parameters.
  head(): string;
}

// Row with the range of a parameter.
class Row {
  readonly element: HTMLElement;
  private key = make("select");
  private from = make("input", { type: "text", size: "7", autocomplete: "off" });
  private to = make("input", { type: "text", size: "7", autocomplete: "off" });
  private way = make("select", { "aria-label": "in" }, make("option", { value: "linear" }, "even steps"), make("option", { value: "log" }, "even ratios"));
  private count = make("input", { type: "number", min: "2", max: "4096", value: "11" });

  constructor(private shape: Shape, private numbers: Numbers, key: string, count: number, remove: (row: Row) => void) {
    this.count.value = String(count);
    const out = button("×", () => remove(this));
    out.setAttribute("aria-label", "Remove parameter");
    const steps = shape.steps ? [this.way, labelled("values", this.count)] : [];
    const name = { class: "range", role: "group", "aria-label": `Range of the ${shape.title}` };
    this.element = make("div", name, labelled("number", this.key), labelled("from", this.from), labelled("to", this.to), ...steps, out);
    this.list(key);
    this.propose();
    this.key.addEventListener("input", () => this.propose());
  }

  get chosen(): string {
    return this.key.value;
  }

  // The list of numbers follows the case.
  list(chosen = this.key.value): void {
    this.key.replaceChildren(...this.numbers.choices(chosen));
    if (chosen) this.key.value = chosen;
  }

  private propose(): void {
    const value = this.numbers.value(this.key.value);
    [this.from.value, this.to.value] = about(value, this.shape.around);
    for (const input of [this.from, this.to]) input.placeholder = value || "value unit";
  }

  toml(): string {
    const ends = `from = ${written(this.from.value.trim())}, to = ${written(this.to.value.trim())}`;
    const range = this.shape.steps ? `${this.way.value} = { ${ends}, count = ${written(this.count.value)} }` : `uniform = { ${ends} }`;
    return `[[parameter]]\nkey = ${JSON.stringify(this.key.value)}\n${range}\n`;
  }
}

export class Parameters {
  readonly element: HTMLElement;
  private rows: Row[] = [];
  private ranges = make("div", { class: "ranges" });
  private add: HTMLButtonElement;
  private byHand = make("input", { type: "checkbox" });
  private text = make("textarea", { spellcheck: "false", rows: "12", wrap: "off" });

  constructor(private shape: Shape, private numbers: Numbers) {
    this.add = button("Add parameter", () => this.insert());
    this.text.setAttribute("aria-label", `File of the ${shape.title}`);
    this.text.hidden = true;
    const byHand = make("label", {}, this.byHand, ` write the file of the ${shape.title} by hand`);
    this.byHand.addEventListener("input", () => {
      const hand = this.byHand.checked;
      if (hand) this.text.value = this.made();
      this.text.hidden = !hand;
      this.ranges.hidden = this.add.hidden = hand;
      if (hand) this.text.focus();
    });
    this.element = make("div", { class: "parameters" }, this.ranges, make("div", { class: "bar" }, this.add, byHand), this.text);
    numbers.onChange(() => {
      if (this.rows.length === 0) this.insert();
      for (const row of this.rows) row.list();
    });
  }

  // A row for a number that no other row has.
  private insert(): void {
    const taken = this.rows.map((row) => row.chosen);
    const key = this.numbers.find((key) => !taken.includes(key), this.shape.first);
    const row = new Row(this.shape, this.numbers, key, this.rows.length ? 4 : 11, (gone) => {
      this.rows = this.rows.filter((other) => other !== gone);
      gone.element.remove();
      this.limit();
      this.add.focus();
    });
    this.rows.push(row);
    this.ranges.append(row.element);
    this.limit();
  }

  // One row again, for a number of the present case.
  reset(): void {
    for (const row of this.rows.splice(0)) row.element.remove();
    if (this.byHand.checked) this.byHand.click();
    this.insert();
  }

  private limit(): void {
    this.add.disabled = this.rows.length >= this.shape.most;
  }

  private made(): string {
    return [this.shape.head(), ...this.rows.map((row) => row.toml())].filter((part) => part).join("\n");
  }

  // The text of the file.
  toml(): string {
    return this.byHand.checked ? this.text.value : this.made();
  }
}
