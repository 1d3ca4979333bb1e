// Charts as the server describes them, drawn with uPlot: the same series, colours and ranges as in its figures.

import uPlot from "uplot";
import { bars } from "./bars";
import { color, fade, variable } from "./colors";
import { button, make, significant } from "./dom";
import { mapReader } from "./map";
import { over, under } from "./paint";
import { rows } from "./rows";
import { shape } from "./shape";
import { span, ticks } from "./ticks";
import { TimeMark } from "./timemark";
import type { AreaChart, Chart, LineChart, MapChart } from "./types";
import { Zoom, type Range, type Side } from "./zoom";

const HEIGHT = 250;
// A rectangle narrower than this [px] zooms only along the other axis.
const NARROW = 24;
const FONT = "12px system-ui, sans-serif";
const number = (value: number | null | undefined) => (value == null ? "" : significant(value));

// Chart with frame, title and caption, updated with its data.
export class ChartView {
  readonly element: HTMLElement;
  private title = make("h3");
  private caption = make("figcaption");
  private body = make("div", { class: "plot" });
  private plot: uPlot | null = null;
  private signature = "";
  private chart: Chart | null = null;
  private visible = true;
  // Whether the drawing is that of an earlier chart.
  private late = false;
  private time = new TimeMark();
  private whole = button("Reset zoom", () => {
    this.zoom.reset();
    this.body.focus();
  });
  private zoom = new Zoom(
    { range: (side) => span(this.chart as Chart, side), log: (side) => this.chart?.[side].log ?? false },
    () => this.zoomed(),
  );

  constructor(actions: HTMLElement[] = []) {
    const named = make("span", { class: "actions" }, this.whole, ...actions);
    this.element = make("figure", {}, make("div", { class: "head" }, this.title, named), this.body, this.caption);
    this.whole.hidden = true;
    this.body.addEventListener("keydown", (event) => {
      const plain = !event.ctrlKey && !event.metaKey && !event.altKey;
      if (this.plot && plain && this.zoom.key(event.key)) event.preventDefault();
    });
    new ResizeObserver(() => this.resize()).observe(this.body);
    new IntersectionObserver((entries) => {
      this.visible = entries.at(-1)?.isIntersecting ?? true;
      if (this.visible && this.late && this.chart) this.show(this.chart);
      if (this.visible && this.plot && this.chart) this.time.place(this.plot, this.chart);
    }).observe(this.element);
  }

  get inView(): boolean {
    return this.visible;
  }

  // Marks a time [µs] on an axis of time; legends have the values there once it rests.
  mark(time: number | null, rests: boolean): void {
    this.time.set(time, rests);
    if (this.plot && this.chart && this.visible) this.time.place(this.plot, this.chart);
  }

  show(chart: Chart): void {
    const first = this.chart === null;
    this.chart = chart;
    this.title.textContent = chart.title;
    this.caption.textContent = chart.caption;
    this.element.dataset["chart"] = chart.name;
    this.whole.setAttribute("aria-label", `Show the whole chart: ${chart.title}`);
    // What nobody sees is drawn when it comes into view: a slider moves the faster for it.
    this.late = !first && !this.visible;
    if (this.late) return;
    if (!first && this.plot && signature(chart) === this.signature) this.update(chart);
    else this.draw();
  }

  // Draws what waits to come into view.
  settle(): void {
    if (!this.late) return;
    this.late = false;
    this.draw();
  }

  // Redraws everything, as after a change of the theme.
  draw(): void {
    const chart = this.chart;
    if (!chart) return;
    this.plot?.destroy();
    this.plot = null;
    if (signature(chart) !== this.signature) this.zoom.reset();
    this.signature = signature(chart);
    const fixed = unzoomed(chart);
    const label = `${chart.title}: ${chart.y.label || "values"} against ${chart.x.label}`;
    this.body.setAttribute("role", fixed ? "group" : "application");
    this.body.setAttribute("aria-label", fixed ? label : `${label}. Plus and minus zoom, arrows move, 0 resets the zoom.`);
    if (fixed) {
      this.body.removeAttribute("tabindex");
      this.body.replaceChildren(fixed);
      return;
    }
    this.body.tabIndex = 0;
    this.body.replaceChildren();
    const width = Math.max(240, this.body.clientWidth || 480);
    const current = () => this.chart as Chart;
    this.plot = new uPlot(options(chart, width, current, this.zoom), data(chart), this.body);
    (this.plot.hooks.draw ??= []).push((plot) => this.time.place(plot, current()));
    // A line that emphasises another has no name and no place in the legend.
    const names = [...this.plot.root.querySelectorAll<HTMLElement>(".u-legend .u-series")].slice(1);
    if (chart.kind === "lines") chart.series.forEach((series, i) => series.name === "" && names[i]?.setAttribute("hidden", ""));
    if (chart.kind === "map") this.body.append(mapReader(this.plot, () => current() as MapChart));
  }

  private update(chart: Chart): void {
    const plot = this.plot;
    if (!plot) return;
    plot.batch(() => {
      plot.setData(data(chart), false);
      this.scale(plot);
    });
    plot.redraw(true, true);
  }

  private zoomed(): void {
    this.whole.hidden = !this.zoom.active;
    if (this.plot) this.scale(this.plot);
  }

  private scale(plot: uPlot): void {
    for (const side of ["x", "y"] as const) {
      const [min, max] = this.zoom.range(side);
      plot.setScale(side, { min, max });
    }
  }

  private resize(): void {
    if (!this.plot) {
      if (this.chart?.kind === "lines") this.draw();
      return;
    }
    const width = Math.max(240, this.body.clientWidth);
    if (Math.abs(width - this.plot.width) > 1) this.plot.setSize({ width, height: HEIGHT });
  }
}

// Chart without axes to zoom; null for the others.
function unzoomed(chart: Chart): HTMLElement | null {
  switch (chart.kind) {
    case "rows": return rows(chart);
    case "bars": return bars(chart);
    case "lines": return chart.true_to_scale ? shape(chart) : null;
    default: return null;
  }
}

// Key of charts that differ only in their numbers.
function signature(chart: Chart): string {
  switch (chart.kind) {
    case "lines": return JSON.stringify([chart.name, chart.x.label, chart.y.label, chart.series.map((s) => [s.name, s.color, s.dashes, s.markers, s.line])]);
    case "areas": return JSON.stringify([chart.name, chart.areas.map((area) => [area.name, area.color])]);
    case "map": return JSON.stringify([chart.name, chart.columns, chart.value_label]);
    case "histogram": return JSON.stringify([chart.name, chart.color]);
    case "rows": case "bars": return chart.kind;
  }
}

function data(chart: Chart): uPlot.AlignedData {
  switch (chart.kind) {
    case "lines": return lineData(chart);
    case "areas": return areaData(chart);
    case "map": return [span(chart, "x"), [null, null]];
    case "histogram": return [chart.middles, chart.parts];
    case "rows": case "bars": return [[]];
  }
}

function lineData(chart: LineChart): uPlot.AlignedData {
  const shared = chart.series[0]?.x ?? [];
  if (chart.series.every((series, index) => index === 0 || !series.x) && shared.every((x) => x !== null)) {
    return [shared as number[], ...chart.series.map((series) => series.y)];
  }
  const tables = chart.series.map((series): uPlot.AlignedData => {
    // A point without a place parts its neighbours: it stands between them, without a value.
    const x = (series.x ?? shared).map((value, i, all) => value ?? ((all[i - 1] ?? NaN) + (all[i + 1] ?? NaN)) / 2);
    const places = x.flatMap((value, index) => (Number.isFinite(value) ? [index] : []));
    places.sort((a, b) => (x[a] as number) - (x[b] as number));
    return [places.map((i) => x[i] as number), places.map((i) => series.y[i] ?? null)];
  });
  return uPlot.join(tables, tables.map((table) => table.map(() => 1 as uPlot.JoinNullMode)));
}

// Stacked areas: the uppermost is drawn first, and the lower ones cover it.
function areaData(chart: AreaChart): uPlot.AlignedData {
  const sums = new Array<number>(chart.positions.length).fill(0);
  const stacked = chart.areas.map((area) => area.heights.map((height, i) => (sums[i] = (sums[i] ?? 0) + height)));
  return [chart.positions, ...stacked.reverse()];
}

function options(chart: Chart, width: number, current: () => Chart, zoom: Zoom): uPlot.Options {
  const ink = variable("--ink");
  const axis = (label: string, side: number): uPlot.Axis => ({
    label,
    labelFont: FONT,
    font: FONT,
    stroke: ink,
    labelSize: 20,
    size: side === 3 ? 58 : 36,
    grid: { stroke: variable("--grid"), width: 1, show: chart.kind !== "map" },
    ticks: { stroke: variable("--grid"), width: 1 },
    values: (_: uPlot, ticks: number[]) => ticks.map((tick) => (tick === null ? "" : significant(tick, 5))),
  });
  return {
    width,
    height: HEIGHT,
    legend: { live: true, show: chart.kind !== "map", markers: { dash: sampleOf } },
    cursor: {
      drag: { x: true, y: true, uni: NARROW, setScale: false },
      y: chart.kind === "map",
      bind: { dblclick: () => () => (zoom.reset(), null) },
    },
    scales: {
      x: { time: false, range: () => zoom.range("x"), distr: chart.x.log ? 3 : 1 },
      y: { range: () => zoom.range("y"), distr: chart.y.log ? 3 : 1 },
    },
    axes: [{ ...axis(chart.x.label, 2), ...ticks(chart, "x", current) }, { ...axis(chart.y.label, 3), ...ticks(chart, "y", current) }],
    series: [{ label: chart.x.label, value: (_, value) => number(value) }, ...seriesOf(chart, current)],
    hooks: {
      drawAxes: [(plot) => under(plot, current())],
      draw: [(plot) => over(plot, current())],
      setSelect: [(plot) => select(plot, zoom)],
    },
  };
}

// Zooms into the rectangle that was dragged.
function select(plot: uPlot, zoom: Zoom): void {
  const { left, top, width, height } = plot.select;
  if (width <= 0 && height <= 0) return;
  const ends = (from: number, to: number, side: Side): Range => [plot.posToVal(from, side), plot.posToVal(to, side)];
  plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
  zoom.show(ends(left, left + width, "x"), ends(top + height, top, "y"));
}

// Kind of line of a series in the legend: curves of one colour differ by it.
function sampleOf(plot: uPlot, series: number): "solid" | "dotted" | "dashed" {
  const dashes = plot.series[series]?.dash;
  if (!dashes?.length) return "solid";
  return (dashes[0] ?? 0) <= 2 ? "dotted" : "dashed";
}

function seriesOf(chart: Chart, current: () => Chart): uPlot.Series[] {
  switch (chart.kind) {
    case "lines":
      return chart.series.map((series) => ({
        label: series.name,
        stroke: color(series.color),
        width: series.line ? Math.max(1, series.width) : 0,
        ...(series.dashes ? { dash: series.dashes.split(" ").map(Number) } : {}),
        points: { show: series.markers, size: 7, fill: color(series.color) },
        ...(series.line ? {} : { paths: () => null }),
        value: (_: uPlot, value: number | null) => number(value),
      }));
    case "areas":
      return chart.areas.map((_, place) => {
        const index = chart.areas.length - 1 - place;
        const area = chart.areas[index];
        return {
          label: area?.name ?? "",
          fill: area?.color ?? "",
          stroke: area?.color ?? "",
          width: 0,
          points: { show: false },
          fillTo: 0,
          // What is read off is the height of the area itself.
          value: (_: uPlot, __: number, ___: number, at: number | null) =>
            at === null ? "" : number((current() as AreaChart).areas[index]?.heights[at]),
        };
      });
    case "map": return [{ label: chart.value_label }];
    case "histogram": {
      const paths = uPlot.paths.bars?.({ size: [1, Infinity], gap: 1 });
      return [{
        label: chart.y.label,
        fill: fade(color(chart.color), 0.75),
        width: 0,
        points: { show: false },
        ...(paths ? { paths } : {}),
        value: (_, value) => number(value),
      }];
    }
    case "rows": case "bars": return [];
  }
}
