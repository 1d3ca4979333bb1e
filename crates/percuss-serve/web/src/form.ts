// Form of the case, made from the description of the keys; every change is an edit of the text.

import { get, make, micro, significant } from "./dom";
import { holds } from "./words";
import type { Field, Start, Unit, Value, Values } from "./types";

// A key and its new value as TOML writes it; none removes the key.
export interface Edit { key: string; value: string | null; nested: boolean }

// A new value, of a slider that may still move.
type Change = (value: string | null, moving?: boolean) => void;

const NUMBER = /^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*)$/;
const TOML_NUMBER = /^[+-]?(\d+(\.\d+)?([eE][+-]?\d+)?|nan|inf)$/;
const STEPS = 400;

const quoted = (text: string) => JSON.stringify(text);

// Text that is not a number is sent as it is; the server returns the error.
export const written = (text: string) => (TOML_NUMBER.test(text) ? text : quoted(text));

export function shown(value: Value | undefined): string {
  if (value === undefined) return "";
  return typeof value === "object" ? value.number : String(value);
}

// Field: elements that follow the values of the case.
interface Control {
  element: HTMLElement;
  input: HTMLElement;
  show(values: Values): void;
  present(values: Values): boolean;
  // The default of the case, where it depends on the rest of it.
  inUse?(value: string): void;
}

export class Form {
  private controls: { key: string; control: Control }[] = [];
  private built = "";
  private values: Values = {};
  // Key of the last edit.
  private last = "";

  constructor(private start: Start, private change: (edits: Edit[], moving: boolean) => void) {
    get("form").addEventListener("submit", (event) => event.preventDefault());
  }

  // Follows the case; what the user is typing in stays as it is, and so do later edits, which still wait for their answer.
  show(values: Values, model: string, inUse?: Record<string, string>, later?: ReadonlyMap<string, Edit>): void {
    this.values = values;
    const layers = layersOf(values);
    const shape = JSON.stringify([model, layers, Object.keys(values).filter((key) => key.startsWith("materials."))]);
    if (shape !== this.built) {
      this.build(model, layers);
      this.built = shape;
    }
    for (const { key, control } of this.controls) {
      const used = inUse?.[key];
      if (used !== undefined) control.inUse?.(used);
      if (!later?.has(key)) control.show(values);
      control.element.hidden = !control.present(values);
    }
  }

  // Marks the field that a problem is about; of a problem with a whole table, the field in it that was edited last.
  mark(key: string): void {
    const own = this.controls.some((entry) => entry.key === key || key.startsWith(`${entry.key}.`));
    const meantKey = !own && this.last.startsWith(`${key}.`) ? this.last : key;
    for (const entry of this.controls) {
      const meant = key !== "" && (entry.key === meantKey || meantKey.startsWith(`${entry.key}.`));
      if (meant) entry.control.input.setAttribute("aria-invalid", "true");
      else entry.control.input.removeAttribute("aria-invalid");
    }
  }

  private build(model: string, layers: number): void {
    const open = new Set(Array.from(get("form").querySelectorAll("details[open]"), (details) => details.id));
    this.controls = [];
    const fields = this.start.fields.flatMap((field) => expand(field, layers));
    const group = (name: string, title: string) => {
      const own = fields.filter((field) => field.key.startsWith(`${name}.`));
      if (own.length === 0) return null;
      const common = own.filter((field) => field.common).map((field) => this.add(field));
      const more = own.filter((field) => !field.common).map((field) => this.add(field));
      const id = `more-${name}`;
      const rest = more.length
        ? make("details", open.has(id) ? { id, open: "" } : { id }, make("summary", {}, `More options: ${title.toLowerCase()}`), ...more)
        : null;
      return make("fieldset", {}, make("legend", {}, title), ...common, rest);
    };
    const options = group(model.replaceAll("-", "_"), `Model ${model}`);
    get("form").replaceChildren(...[group("projectile", "Projectile"), group("target", "Target"), options].filter((g) => g !== null));
  }

  private add(field: Field): HTMLElement {
    const control = this.control(field);
    if (field.help) control.input.setAttribute("aria-description", field.help);
    this.controls.push({ key: field.key, control });
    return control.element;
  }

  private control(field: Field): Control {
    const label = field.key.split(".").slice(1).join(" ").replaceAll("_", " ").replace(/^layers (\d+)/, (_, i) => `layer ${Number(i) + 1}`);
    const id = `field-${field.key.replaceAll(".", "-")}`;
    const frame = make("div", { class: `field of-${field.kind}`, title: field.help }, make("label", { for: id }, label));
    const edit: Change = (value, moving = false) => {
      this.last = field.key;
      this.change([{ key: field.key, value, nested: field.nested }], moving);
    };
    // A field within a value is there with the value; a field that belongs to another form of target is not in the way.
    const present = (values: Values) => {
      if (field.key in values) return true;
      // Of several forms of a value the one that the case gives.
      if (field.alternative) return Object.keys(values).some((key) => key.startsWith(`${field.key}.`));
      const around = field.key.slice(0, field.key.lastIndexOf("."));
      if (field.nested) return Object.keys(values).some((key) => key.startsWith(`${around}.`));
      const single = field.key === "target.material" || field.key === "target.thickness";
      return !single || !Object.keys(values).some((key) => /^target\.(layers|rigid_wall|constant_pressure)/.test(key));
    };
    switch (field.kind) {
      case "material": return { ...this.material(field, id, frame, edit), present };
      case "quantity": return { ...quantity(field, id, frame, edit), present };
      case "number": return { ...number(field, id, frame, edit), present };
      case "boolean": return { ...choice(field, ["true", "false"], id, frame, edit, shown), present };
      case "choice": return { ...choice(field, field.choices ?? [], id, frame, edit, (value) => value === undefined ? "" : quoted(shown(value))), present };
      case "text": return { ...text(field, id, frame, edit), present };
    }
  }

  private material(field: Field, id: string, frame: HTMLElement, edit: Change) {
    const input = make("select", { id });
    const find = make("input", { type: "search", placeholder: "find", autocomplete: "off", spellcheck: "false", "aria-label": `Find a material: ${frame.textContent}` });
    const card = make("a", { target: "_blank", rel: "noopener" }, "sources");
    const own = new Set(Object.keys(this.values).map((key) => /^materials\.([^.]+)\./.exec(key)?.[1]).filter((name) => name !== undefined));
    frame.append(input, find, card);
    input.addEventListener("input", () => edit(quoted(input.value)));
    // The materials that are found, and the chosen one.
    const list = () => input.replaceChildren(...this.choices(find.value, input.value, own));
    find.addEventListener("input", list);
    find.addEventListener("keydown", (event) => {
      if (event.key === "Escape") find.value = "";
      else if (event.key !== "Enter") return;
      event.preventDefault();
      const first = find.value.trim() === "" ? undefined : this.choices(find.value, "", own)[0]?.querySelector("option");
      find.value = "";
      list();
      if (!first) return;
      input.value = first.value;
      edit(quoted(first.value));
    });
    const show = (values: Values) => {
      const name = shown(values[field.key]);
      if (![...input.options].some((known) => known.value === name)) input.replaceChildren(...this.choices(find.value, name, own));
      input.value = name;
      card.href = `/materials/${encodeURIComponent(name)}`;
      card.hidden = own.has(name);
      const found = this.start.materials.find((material) => material.id === name || (material.family === name && material.recommended));
      card.title = found ? `${found.name}; ${found.sources.join(", ")}` : "";
    };
    return { element: frame, input, show };
  }

  // Materials with all words, by their families; the one that is chosen is always there.
  private choices(words: string, chosen: string, own: Set<string>): HTMLElement[] {
    const families = new Map<string, HTMLElement[]>();
    const names = [...own].filter((name) => holds(name.toLowerCase(), words) || name === chosen);
    if (names.length) families.set("this case", names.map((name) => make("option", { value: name }, name)));
    for (const material of [...this.start.materials].sort((a, b) => compare(a.family ?? "other", b.family ?? "other"))) {
      const family = material.family ?? "other";
      const byFamily = material.recommended && material.family !== null;
      const found = holds(material.words, words);
      const options = families.get(family) ?? [];
      if (byFamily && (found || chosen === family)) options.unshift(make("option", { value: family }, `${family} ★`));
      if (found || chosen === material.id) options.push(make("option", { value: material.id }, `${material.id} (${material.trust})`));
      if (options.length) families.set(family, options);
    }
    const known = [...families.values()].flat().some((option) => option.getAttribute("value") === chosen);
    if (!known && chosen !== "") families.set("named by the case", [make("option", { value: chosen }, chosen)]);
    return [...families].map(([family, list]) => make("optgroup", { label: family }, ...list));
  }
}

const compare = (a: string, b: string) => (a < b ? -1 : Number(a > b));

// Layers that a case has in a list.
export function layersOf(values: Values): number {
  return Object.keys(values)
    .map((key) => /^target\.layers\.(\d+)\./.exec(key)?.[1])
    .reduce((most, index) => Math.max(most, index === undefined ? 0 : Number(index) + 1), 0);
}

// Fields of the entries of a list, instead of the template field.
export function expand(field: Field, layers: number): Field[] {
  if (!field.key.includes(".*.")) return [field];
  return Array.from({ length: layers }, (_, index) => ({ ...field, key: field.key.replace("*", String(index)), nested: false }));
}

// Follows what is typed. An emptied field takes its key out of the case when it is left: until then another value may be typed, which
// keeps the place and the comment of the key.
function onEntry(input: HTMLInputElement, write: () => void): void {
  input.addEventListener("input", () => input.value.trim() !== "" && write());
  input.addEventListener("change", () => input.value.trim() === "" && write());
}

const isFocused = (element: Element) => document.activeElement === element;

function toSI(value: number, unit: Unit | undefined): number {
  return unit ? value * unit.factor + unit.offset : value;
}

function fromSI(si: number, unit: Unit | undefined): number {
  return unit ? (si - unit.offset) / unit.factor : si;
}

function slider(id: string, label: string): HTMLInputElement {
  return make("input", { type: "range", min: "0", max: String(STEPS), step: "1", "aria-label": `${label}, slider`, id: `${id}-slider` });
}

// Range of a slider, wide enough for the value.
function rangeOf(field: Field, si: number): [number, number] {
  const [low, high] = field.slider ?? [0, 1];
  return [Math.min(low, si), Math.max(high, si)];
}

// Default as the field shows it: its value, where there is one.
const asDefault = (value: string) => `${micro(value)} (default)`;

function ofDefault(field: Field): string {
  return field.default === null ? "default" : asDefault(field.default.replaceAll('"', ""));
}

// Shows the default of a case in an empty field.
const inUse = (input: HTMLInputElement) => (value: string) => {
  input.placeholder = asDefault(value);
};

function quantity(field: Field, id: string, frame: HTMLElement, edit: Change) {
  const units = field.units ?? [];
  const input = make("input", { id, type: "text", inputmode: "decimal", placeholder: ofDefault(field) });
  const unit = make("select", { "aria-label": `${field.key.replaceAll("_", " ").replaceAll(".", " ")}, unit` });
  const known = [...units.map((u) => u.symbol), ...(field.words ?? [])];
  unit.append(...known.map((symbol) => make("option", { value: symbol }, symbol)));
  if (field.usual) unit.value = field.usual;
  const find = (symbol: string) => units.find((u) => u.symbol === symbol);
  const range = field.slider ? slider(id, frame.textContent ?? "") : null;
  frame.append(input, unit);
  if (range) frame.append(range);
  let limits: [number, number] = [0, 1];
  let before = "";
  const write = (moving = false) => {
    if (field.words?.includes(unit.value)) return edit(quoted(unit.value));
    if (input.value.trim() === "") return edit(null);
    edit(quoted(`${input.value.trim()} ${unit.value}`), moving);
  };
  onEntry(input, () => write());
  unit.addEventListener("input", () => {
    const si = toSI(Number(input.value), find(before));
    // Another unit is another way to write the same quantity.
    if (input.value.trim() !== "" && Number.isFinite(si) && find(unit.value) && find(before)) input.value = significant(fromSI(si, find(unit.value)), 7);
    if (input.value.trim() === "" && find(unit.value) && range) input.value = significant(fromSI(limits[1] / 2, find(unit.value)), 3);
    before = unit.value;
    write();
  });
  range?.addEventListener("input", () => {
    const si = limits[0] + ((limits[1] - limits[0]) * Number(range.value)) / STEPS;
    const step = fromSI((limits[1] - limits[0]) / STEPS, { ...(find(unit.value) ?? { symbol: "", factor: 1 }), offset: 0 });
    const digits = Math.max(0, -Math.floor(Math.log10(step)));
    input.value = String(Number(fromSI(si, find(unit.value)).toFixed(digits)));
    write(true);
  });
  const show = (values: Values) => {
    const text = shown(values[field.key]);
    const word = field.words?.includes(text) ?? false;
    const [, digits, symbol] = NUMBER.exec(text) ?? [];
    const named = word ? text : (symbol ?? "");
    // While a number is typed it may be none, and what follows it no unit.
    if (text !== "" && !isFocused(unit) && !isFocused(input)) {
      if (![...unit.options].some((option) => option.value === named)) unit.append(make("option", { value: named }, named || "no unit"));
      unit.value = named;
    }
    before = unit.value;
    if (!isFocused(input)) input.value = word ? "" : (digits ?? text);
    input.disabled = word;
    if (range) {
      const si = toSI(Number(digits), find(named));
      range.disabled = digits === undefined || !find(named);
      if (!isFocused(range) && Number.isFinite(si)) {
        limits = rangeOf(field, si);
        range.value = String(Math.round((STEPS * (si - limits[0])) / (limits[1] - limits[0])));
      }
      range.setAttribute("aria-valuetext", text);
    }
  };
  return { element: frame, input, show, inUse: inUse(input) };
}

function number(field: Field, id: string, frame: HTMLElement, edit: Change) {
  const input = make("input", { id, type: "text", inputmode: "decimal", placeholder: ofDefault(field) });
  const range = field.slider ? slider(id, frame.textContent ?? "") : null;
  frame.append(input);
  if (range) frame.append(range);
  let limits: [number, number] = [0, 1];
  onEntry(input, () => {
    const text = input.value.trim();
    edit(text === "" ? null : written(text));
  });
  range?.addEventListener("input", () => {
    const value = limits[0] + ((limits[1] - limits[0]) * Number(range.value)) / STEPS;
    input.value = field.integer ? String(Math.round(value)) : significant(value, 3);
    edit(input.value, true);
  });
  const show = (values: Values) => {
    const text = shown(values[field.key]);
    if (!isFocused(input)) input.value = text;
    if (range && !isFocused(range) && Number.isFinite(Number(text))) {
      limits = rangeOf(field, Number(text));
      range.value = String(Math.round((STEPS * (Number(text) - limits[0])) / (limits[1] - limits[0])));
    }
  };
  return { element: frame, input, show, inUse: inUse(input) };
}

// One of a few values, each as TOML writes it; `written` writes the value of a case in the same way.
function choice(
  field: Field,
  choices: string[],
  id: string,
  frame: HTMLElement,
  edit: Change,
  written: (value: Value | undefined) => string,
) {
  const input = make("select", { id });
  const words = (toml: string) => toml.replaceAll('"', "").replace(/^\{ (\w+) = .*\}$/, "$1").replaceAll("_", " ");
  const optional = !["projectile.material", "target.material"].includes(field.key);
  const none = make("option", { value: "" }, ofDefault(field));
  if (optional) input.append(none);
  input.append(...choices.map((toml) => make("option", { value: toml }, words(toml))));
  input.addEventListener("input", () => edit(input.value === "" ? null : input.value));
  frame.append(input);
  const show = (values: Values) => {
    // A choice with numbers in it is recognised by the key of its table.
    const inside = choices.find((toml) => {
      const name = /^\{ (\w+) =/.exec(toml)?.[1];
      return name !== undefined && Object.keys(values).some((key) => key.startsWith(`${field.key}.${name}`));
    });
    input.value = inside ?? written(values[field.key]);
  };
  const inUse = (value: string) => {
    none.textContent = asDefault(value);
  };
  return { element: frame, input, show, inUse };
}

function text(field: Field, id: string, frame: HTMLElement, edit: Change) {
  const input = make("input", { id, type: "text", placeholder: ofDefault(field) });
  onEntry(input, () => edit(input.value.trim() === "" ? null : quoted(input.value)));
  frame.append(input);
  const show = (values: Values) => {
    if (!isFocused(input)) input.value = shown(values[field.key]);
  };
  return { element: frame, input, show, inUse: inUse(input) };
}
