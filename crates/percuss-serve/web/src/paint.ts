// What uPlot does not draw: bands, cells of a map, marks with their names, error bars.

import type uPlot from "uplot";
import { color, fade, variable } from "./colors";
import { mapCanvas } from "./map";
import type { Chart, LineChart, Mark } from "./types";

// What lies below the lines: bands of ranges, and the cells of a map.
export function under(plot: uPlot, chart: Chart): void {
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  if (chart.kind === "map") {
    ctx.imageSmoothingEnabled = false;
    const rowCount = chart.cells.length / chart.columns;
    const canvas = mapCanvas(chart, rowCount);
    // All of the map, of which a zoomed chart shows a part.
    const [left, right] = (chart.x.range ?? [0, 1]).map((x) => plot.valToPos(x, "x", true)) as [number, number];
    const [bottom, top] = (chart.y.range ?? [0, 1]).map((y) => plot.valToPos(y, "y", true)) as [number, number];
    ctx.drawImage(canvas, left, top, right - left, bottom - top);
    for (const x of chart.vertical_lines) line(plot, chart, { name: "", value: x, vertical: true }, "#000", null, []);
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
export function over(plot: uPlot, chart: Chart): void {
  if (chart.kind !== "lines" && chart.kind !== "histogram") return;
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  // Names of many marks stand below each other, for those that are close.
  const vertical = chart.marks.filter((mark) => mark.vertical);
  const isCrowded = chart.kind === "histogram" || vertical.length > 1;
  const names: Box[] = [];
  vertical.forEach((mark, row) => line(plot, chart, mark, variable("--soft"), isCrowded ? row : null, names));
  // After the others, whose names they avoid.
  const horizontal = chart.marks.filter((mark) => !mark.vertical);
  for (const mark of horizontal) line(plot, chart, mark, variable("--soft"), null, names);
  if (chart.kind === "lines") for (const series of chart.series) errorBars(plot, chart, series);
  ctx.restore();
}

// Where a name stands.
interface Box {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

function around(x: number, y: number, width: number): Box {
  const ratio = devicePixelRatio;
  return { left: x - 4 * ratio, right: x + width + 4 * ratio, top: y - 13 * ratio, bottom: y + 4 * ratio };
}

// A mark; the name of a vertical one stands in a row counted from the top. It is added to the names.
function line(plot: uPlot, chart: Chart, mark: Mark, stroke: string, row: number | null, names: Box[]): void {
  const { ctx, bbox } = plot;
  const ratio = devicePixelRatio;
  const at = plot.valToPos(mark.value, mark.vertical ? "x" : "y", true);
  // A zoomed chart may not hold it.
  const [start, length] = mark.vertical ? [bbox.left, bbox.width] : [bbox.top, bbox.height];
  if (at < start - 1 || at > start + length + 1) return;
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
  const top = bbox.top + (13 + 15 * (row ?? 0)) * ratio;
  const [x, y] = mark.vertical ? [Math.min(at + 4 * ratio, right), top] : freePlace(plot, chart, at, width, right, top, names);
  names.push(around(x, y, width));
  // A rim in the colour of the ground keeps the name legible over lines, and the lines visible.
  ctx.textAlign = "left";
  ctx.strokeStyle = variable("--card");
  ctx.lineWidth = 3 * ratio;
  ctx.strokeText(mark.name, x, y);
  ctx.fillStyle = variable("--ink");
  ctx.fillText(mark.name, x, y);
}

// The place of the name of a horizontal mark, above or below it, where it covers least of curves, other marks and their names; at the right if all
// are alike.
function freePlace(plot: uPlot, chart: Chart, at: number, width: number, right: number, top: number, names: Box[]): [number, number] {
  const { bbox } = plot;
  const ratio = devicePixelRatio;
  const obstacles: [number, number][] = [];
  const xs = plot.data[0] ?? [];
  for (const ys of plot.data.slice(1)) {
    let before: [number, number] | null = null;
    for (let i = 0; i < xs.length; i++) {
      const [vx, vy] = [xs[i], ys?.[i]];
      if (vx == null || vy == null) continue;
      const point: [number, number] = [plot.valToPos(vx, "x", true), plot.valToPos(vy, "y", true)];
      obstacles.push(point);
      // Between points that are far from each other lies the line.
      const [dx, dy] = before ? [point[0] - before[0], point[1] - before[1]] : [0, 0];
      const parts = Math.min(8, Math.ceil(Math.hypot(dx, dy) / (6 * ratio)));
      for (let part = 1; part < parts; part++) obstacles.push([point[0] - dx * part / parts, point[1] - dy * part / parts]);
      before = point;
    }
  }
  const verticals = "marks" in chart && chart.kind === "lines" ? chart.marks.filter((mark) => mark.vertical).map((mark) => plot.valToPos(mark.value, "x", true)) : [];
  const left = bbox.left + 6 * ratio;
  let best: [number, number] = [right, Math.max(at - 5 * ratio, top)];
  let least = Infinity;
  for (const y of [at - 5 * ratio, at + 14 * ratio]) {
    if (y < top || y > bbox.top + bbox.height) continue;
    for (let step = 0; step <= 12; step++) {
      const x = right - (right - left) * step / 12;
      if (x < left - 1) continue;
      const box = around(x, y, width);
      const covers = ([px, py]: [number, number]) => px > box.left && px < box.right && py > box.top && py < box.bottom;
      const crossed = verticals.filter((place) => place > box.left && place < box.right).length;
      const hidden = names.filter((name) => name.left < box.right && box.left < name.right && name.top < box.bottom && box.top < name.bottom).length;
      const cost = obstacles.filter(covers).length + 20 * crossed + 200 * hidden;
      if (cost < least) [best, least] = [[x, y], cost];
    }
  }
  return best;
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
