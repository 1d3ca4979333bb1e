// Comparison of all models at the velocity of the case, updated when the case changes.

import { Refused, follow } from "./api";
import { ChartView } from "./charts";
import { make } from "./dom";
import type { Views } from "./panel";
import { comparison } from "./tables";
import type { Comparison } from "./types";

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
