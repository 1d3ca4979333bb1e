// Tabs: one panel in view, its name in a list that the arrow keys walk.

import { make } from "./dom";

// Places of the keys in a list of `count` tabs, from the place `at`.
const MOVES: Record<string, (at: number, count: number) => number> = {
  ArrowRight: (at, count) => (at + 1) % count,
  ArrowLeft: (at, count) => (at + count - 1) % count,
  Home: () => 0,
  End: (_, count) => count - 1,
};

export function tabs(name: string, titles: string[], panels: HTMLElement[]): HTMLElement[] {
  const list = make("div", { role: "tablist", "aria-label": name });
  const heads = titles.map((title, i) => {
    const id = `${name.toLowerCase()}-${i}`;
    const panel = panels[i];
    panel?.setAttribute("role", "tabpanel");
    panel?.setAttribute("id", `${id}-panel`);
    panel?.setAttribute("aria-labelledby", `${id}-tab`);
    const head = make("button", { type: "button", role: "tab", id: `${id}-tab`, "aria-controls": `${id}-panel` }, title);
    head.addEventListener("click", () => select(i));
    return head;
  });

  // One tab takes part in the order of the Tab key.
  function select(chosen: number): void {
    heads.forEach((head, i) => {
      head.setAttribute("aria-selected", String(i === chosen));
      head.tabIndex = i === chosen ? 0 : -1;
    });
    panels.forEach((panel, i) => (panel.hidden = i !== chosen));
  }

  list.addEventListener("keydown", (event) => {
    const at = heads.findIndex((head) => head === document.activeElement);
    const next = at < 0 ? undefined : MOVES[event.key]?.(at, heads.length);
    if (next === undefined) return;
    event.preventDefault();
    select(next);
    heads[next]?.focus();
  });
  list.append(...heads);
  select(0);
  return [list, ...panels];
}
