// Mark of a time on a chart with an axis of time: a line above the drawing, which need not be drawn again.

import type uPlot from "uplot";
import { make } from "./dom";
import type { Chart } from "./types";
import type { Side } from "./zoom";

// Label of an axis of time, in the unit of the mark.
const LABEL = "Time (µs)";

export class TimeMark {
  private line = make("div", { class: "time-mark", "aria-hidden": "true" });
  private time: number | null = null;
  private rests = true;

  set(time: number | null, rests: boolean): void {
    this.time = time;
    this.rests = rests;
  }

  place(plot: uPlot, chart: Chart): void {
    const side = (["x", "y"] as const).find((candidate: Side) => chart[candidate].label === LABEL);
    if (!side || this.time === null) {
      this.line.remove();
      return;
    }
    if (this.line.parentElement !== plot.over) plot.over.append(this.line);
    const at = plot.valToPos(this.time, side);
    const length = side === "x" ? plot.over.clientWidth : plot.over.clientHeight;
    this.line.hidden = !(at >= 0 && at <= length);
    this.line.classList.toggle("level", side === "y");
    this.line.style.transform = side === "x" ? `translateX(${at}px)` : `translateY(${at}px)`;
    this.line.dataset["time"] = this.time.toFixed(3);
    // A pointer in the chart has its own values in the legend.
    const isRead = (plot.cursor.left ?? -10) >= 0;
    if (this.rests && side === "x" && !isRead && chart.kind !== "map") plot.setLegend({ idx: plot.valToIdx(this.time) }, false);
  }
}
