// Creation of elements and formatting of numbers.

type Child = Node | string | null;

export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  // Files keep the `us` that they are written with.
  const typeset = (child: Node | string) => (typeof child === "string" && tag !== "pre" ? micro(child) : child);
  element.append(...children.filter((child): child is Node | string => child !== null).map(typeset));
  return element;
}

export function get<T extends HTMLElement>(id: string): T {
  const element = document.getElementById(id);
  if (!element) throw new Error(`the page has no element ${id}`);
  return element as T;
}

export function button(text: string, action: () => void): HTMLButtonElement {
  const element = make("button", { type: "button" }, text);
  element.addEventListener("click", action);
  return element;
}

// The sign of microseconds, which are `us` in files and in the terminal.
export function micro(text: string): string {
  return text.replace(/(\d) us\b/g, "$1 µs");
}

// Number of a table, to three significant digits: the whole number is shown where the pointer rests. A dash without one.
export function figure(value: number | null | undefined, digits = 3): string | HTMLElement {
  if (value == null) return "–";
  const shown = significant(value, digits);
  return shown === String(value) ? shown : make("data", { value: String(value), title: String(value) }, shown);
}

// Label with its unit in parentheses.
export function withUnit(label: string, unit: string): string {
  return unit ? `${label} (${unit === "us" ? "µs" : unit})` : label;
}

// At most `digits` significant digits, no trailing zeros, no exponent for ordinary numbers.
export function significant(value: number, digits = 3): string {
  if (!Number.isFinite(value) || value === 0) return String(value);
  const size = Math.floor(Math.log10(Math.abs(value)));
  if (size < -4 || size > 8) return String(Number(value.toPrecision(digits)));
  return String(Number(value.toFixed(Math.max(0, digits - 1 - size))));
}

// Table; columns from the second on are numbers unless listed in `texts`.
export function table(head: string[], rows: (string | Node)[][], texts: number[] = []): HTMLElement {
  const cell = (tag: "th" | "td") => (content: string | Node, column: number) => {
    const element = make(tag, {}, content);
    if (column > 0 && !texts.includes(column)) element.className = "number";
    if (tag === "th") element.setAttribute("scope", "col");
    return element;
  };
  const body = make("tbody", {}, ...rows.map((row) => make("tr", {}, ...row.map(cell("td")))));
  const heading = make("thead", {}, make("tr", {}, ...head.map(cell("th"))));
  return make("div", { class: "wide", tabindex: "0" }, make("table", {}, heading, body));
}

// Pairs of label and value; long texts come last.
export function pairs(list: [string, string][]): HTMLElement[] {
  const long = ([, value]: [string, string]) => value.length > 36;
  const sorted = [...list].sort((a, b) => Number(long(a)) - Number(long(b)));
  return sorted.map((pair) => make("div", long(pair) ? { class: "long" } : {}, make("dt", {}, pair[0]), make("dd", {}, pair[1])));
}

export function download(name: string, content: BlobPart, type: string): void {
  const address = URL.createObjectURL(new Blob([content], { type }));
  const link = make("a", { href: address, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}

// Scrolls to an element, and keeps it there while what stands above it still grows; a hand on the page ends that.
export function bring(element: HTMLElement): void {
  element.scrollIntoView();
  const growth = new ResizeObserver(() => element.scrollIntoView());
  growth.observe(document.body);
  const end = (): void => growth.disconnect();
  for (const kind of ["wheel", "keydown", "pointerdown", "touchstart"]) addEventListener(kind, end, { once: true });
  setTimeout(end, 5000);
}
