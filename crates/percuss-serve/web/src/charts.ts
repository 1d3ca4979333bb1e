// Charts as the server describes them, drawn with uPlot: the same series, colours and ranges as in its figures.

import uPlot from "uplot";
import { color, fade, variable } from "./colors";
import { make, significant } from "./dom";
import { mapCanvas, mapReader } from "./map";
import { rows } from "./rows";
import { shape } from "./shape";
import type { AreaChart, Chart, LineChart, MapChart, Mark } from "./types";

const HEIGHT = 250;
const FONT = "12px system-ui, sans-serif";
const number = (value: number | null | undefined) => (value == null ? "–" : significant(value));

// A chart in its frame, which follows the data that it is given.
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

  constructor(actions: HTMLElement[] = []) {
    this.element = make("figure", {}, make("div", { class: "head" }, this.title, ...actions), this.body, this.caption);
    new ResizeObserver(() => this.resize()).observe(this.body);
    new IntersectionObserver((entries) => {
      this.visible = entries.at(-1)?.isIntersecting ?? true;
      if (this.visible && this.late && this.chart) this.show(this.chart);
    }).observe(this.element);
  }

  show(chart: Chart): void {
    const first = this.chart === null;
    this.chart = chart;
    this.title.textContent = chart.title;
    this.caption.textContent = chart.caption;
    this.element.dataset["chart"] = chart.name;
    this.body.setAttribute("role", "img");
    this.body.setAttribute("aria-label", `${chart.title}: ${chart.y.label || "values"} against ${chart.x.label}`);
    // What nobody sees is drawn when it comes into view: a slider moves the faster for it.
    this.late = !first && !this.visible;
    if (this.late) return;
    if (!first && this.plot && signature(chart) === this.signature) this.update(chart);
    else this.draw();
  }

  // Draws everything anew, as after a change of the theme.
  draw(): void {
    const chart = this.chart;
    if (!chart) return;
    this.plot?.destroy();
    this.plot = null;
    this.signature = signature(chart);
    if (chart.kind === "rows" || (chart.kind === "lines" && chart.true_to_scale)) {
      this.body.removeAttribute("role");
      this.body.replaceChildren(chart.kind === "rows" ? rows(chart) : shape(chart));
      return;
    }
    this.body.replaceChildren();
    const width = Math.max(240, this.body.clientWidth || 480);
    const current = () => this.chart as Chart;
    this.plot = new uPlot(options(chart, width, current), data(chart), this.body);
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
      plot.setScale("x", limits(chart, "x"));
      plot.setScale("y", limits(chart, "y"));
    });
    plot.redraw(true, true);
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

// What makes two charts differ in more than their numbers.
function signature(chart: Chart): string {
  switch (chart.kind) {
    case "lines": return JSON.stringify([chart.name, chart.x.label, chart.y.label, chart.series.map((s) => [s.name, s.color, s.dashes, s.markers, s.line])]);
    case "areas": return JSON.stringify([chart.name, chart.areas.map((area) => [area.name, area.color])]);
    case "map": return JSON.stringify([chart.name, chart.columns, chart.value_label]);
    case "rows": return "rows";
  }
}

// Range of an axis; that of its values, with some room, where the axis is logarithmic and has none of its own.
function span(chart: Chart, side: "x" | "y"): [number, number] {
  const range = chart[side].range;
  if (range) return range;
  const values = chart.kind === "lines" ? chart.series.flatMap((series) => (side === "x" ? (series.x ?? []) : series.y)) : [];
  const positive = values.filter((value): value is number => value !== null && value > 0);
  return positive.length ? [Math.min(...positive) / 1.15, Math.max(...positive) * 1.15] : [1, 10];
}

function limits(chart: Chart, side: "x" | "y"): { min: number; max: number } {
  const [min, max] = span(chart, side);
  return { min, max };
}

function data(chart: Chart): uPlot.AlignedData {
  switch (chart.kind) {
    case "lines": return lineData(chart);
    case "areas": return areaData(chart);
    case "map": return [span(chart, "x"), [null, null]];
    case "rows": return [[]];
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

// The areas stand on each other: the uppermost is drawn first and the ones below cover it.
function areaData(chart: AreaChart): uPlot.AlignedData {
  const sums = new Array<number>(chart.positions.length).fill(0);
  const stacked = chart.areas.map((area) => area.heights.map((height, i) => (sums[i] = (sums[i] ?? 0) + height)));
  return [chart.positions, ...stacked.reverse()];
}

function options(chart: Chart, width: number, current: () => Chart): uPlot.Options {
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
    legend: { live: true, show: chart.kind !== "map" },
    cursor: { drag: { x: false, y: false }, y: chart.kind === "map" },
    scales: {
      x: { time: false, range: () => span(current(), "x"), distr: chart.x.log ? 3 : 1 },
      y: { range: () => span(current(), "y"), distr: chart.y.log ? 3 : 1 },
    },
    axes: [{ ...axis(chart.x.label, 2), ...meshes(chart, current) }, axis(chart.y.label, 3)],
    series: [{ label: chart.x.label, value: (_, value) => number(value) }, ...seriesOf(chart, current)],
    hooks: {
      drawAxes: [(plot) => under(plot, current())],
      draw: [(plot) => over(plot, current())],
    },
  };
}

// On a logarithmic axis the places of the points are the numbers that a reader looks for.
function meshes(chart: Chart, current: () => Chart): uPlot.Axis {
  if (!chart.x.log) return {};
  const places = () => {
    const shown = current();
    return shown.kind === "lines" ? (shown.series[0]?.x ?? []).filter((x): x is number => x !== null) : [];
  };
  return { splits: places, filter: (_, splits) => splits };
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
            at === null ? "–" : number((current() as AreaChart).areas[index]?.heights[at]),
        };
      });
    case "map": return [{ label: chart.value_label }];
    case "rows": return [];
  }
}

// What lies below the lines: bands of ranges, and the cells of a map.
function under(plot: uPlot, chart: Chart): void {
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  if (chart.kind === "map") {
    ctx.imageSmoothingEnabled = false;
    const rowCount = chart.cells.length / chart.columns;
    const canvas = mapCanvas(chart, rowCount);
    ctx.drawImage(canvas, bbox.left, bbox.top, bbox.width, bbox.height);
    for (const x of chart.vertical_lines) line(plot, { name: "", value: x, vertical: true }, "#000");
  }
  if (chart.kind === "lines") for (const series of chart.series) band(plot, chart, series);
  ctx.restore();
}

function band(plot: uPlot, chart: LineChart, series: LineChart["series"][number]): void {
  const x = series.x ?? chart.series[0]?.x ?? [];
  const ends = series.band ?? [];
  plot.ctx.fillStyle = fade(color(series.color), 0.18);
  for (let i = 0; i + 1 < ends.length; i++) {
    const corners = [i, i + 1].map((at) => [x[at], ends[at]?.[0], ends[at]?.[1]]);
    if (corners.some((corner) => corner.some((value) => value == null))) continue;
    const [[xa, la, ha], [xb, lb, hb]] = corners as [number[], number[]];
    plot.ctx.beginPath();
    for (const [px, py] of [[xa, la], [xb, lb], [xb, hb], [xa, ha]]) {
      plot.ctx.lineTo(plot.valToPos(px as number, "x", true), plot.valToPos(py as number, "y", true));
    }
    plot.ctx.fill();
  }
}

// What lies above the lines: marks with their names, and error bars.
function over(plot: uPlot, chart: Chart): void {
  if (chart.kind !== "lines") return;
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  for (const mark of chart.marks) line(plot, mark, variable("--soft"));
  for (const series of chart.series) errorBars(plot, chart, series);
  ctx.restore();
}

function line(plot: uPlot, mark: Mark, stroke: string): void {
  const { ctx, bbox } = plot;
  const ratio = devicePixelRatio;
  const at = plot.valToPos(mark.value, mark.vertical ? "x" : "y", true);
  ctx.strokeStyle = stroke;
  ctx.lineWidth = ratio;
  ctx.setLineDash([4 * ratio, 3 * ratio]);
  ctx.beginPath();
  if (mark.vertical) {
    ctx.moveTo(at, bbox.top);
    ctx.lineTo(at, bbox.top + bbox.height);
  } else {
    ctx.moveTo(bbox.left, at);
    ctx.lineTo(bbox.left + bbox.width, at);
  }
  ctx.stroke();
  ctx.setLineDash([]);
  if (!mark.name) return;
  ctx.font = `${12 * ratio}px system-ui, sans-serif`;
  const width = ctx.measureText(mark.name).width;
  const right = bbox.left + bbox.width - width - 6 * ratio;
  const x = mark.vertical ? Math.min(at + 4 * ratio, right) : right;
  const y = mark.vertical ? bbox.top + bbox.height - 8 * ratio : Math.max(at - 5 * ratio, bbox.top + 13 * ratio);
  // A rim in the colour of the ground keeps the name legible over lines, and the lines visible.
  ctx.textAlign = "left";
  ctx.strokeStyle = variable("--card");
  ctx.lineWidth = 3 * ratio;
  ctx.strokeText(mark.name, x, y);
  ctx.fillStyle = variable("--ink");
  ctx.fillText(mark.name, x, y);
}

function errorBars(plot: uPlot, chart: LineChart, series: LineChart["series"][number]): void {
  const x = series.x ?? chart.series[0]?.x ?? [];
  plot.ctx.strokeStyle = color(series.color);
  plot.ctx.lineWidth = 1.5 * devicePixelRatio;
  (series.errors ?? []).forEach(([below, above], i) => {
    const [at, y] = [x[i], series.y[i]];
    if (at == null || y == null || below + above === 0) return;
    const place = plot.valToPos(at, "x", true);
    plot.ctx.beginPath();
    plot.ctx.moveTo(place, plot.valToPos(y - below, "y", true));
    plot.ctx.lineTo(place, plot.valToPos(y + above, "y", true));
    plot.ctx.stroke();
  });
}
