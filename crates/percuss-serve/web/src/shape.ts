// Outlines drawn to scale.

import { color, variable } from "./colors";
import { make, significant } from "./dom";
import type { LineChart } from "./types";

const NAMESPACE = "http://www.w3.org/2000/svg";

function element(name: string, attributes: Record<string, string | number>): SVGElement {
  const made = document.createElementNS(NAMESPACE, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  return made;
}

// A round number of millimetres, about a fifth of the width.
export function rounded(width: number): number {
  const size = 10 ** Math.floor(Math.log10(width / 4));
  return [5, 2, 1].map((factor) => factor * size).find((length) => length <= width / 4) ?? size;
}

export function shape(chart: LineChart): HTMLElement {
  const first = chart.series[0]?.x ?? [];
  const points = chart.series.map((series) => (series.x ?? first).map((x, i) => [x, series.y[i] ?? null] as const));
  const known = points.flat().filter((point): point is readonly [number, number] => point[0] !== null && point[1] !== null);
  const xs = known.map((point) => point[0]);
  const ys = known.map((point) => point[1]);
  const [left, right] = [Math.min(...xs), Math.max(...xs)];
  const [low, high] = [Math.min(...ys), Math.max(...ys)];
  const width = right - left || 1;
  const margin = 0.04 * width;
  const bar = rounded(width);
  const height = high - low + 5 * margin;
  const svg = element("svg", { viewBox: `${left - margin} ${-high - margin} ${width + 2 * margin} ${height}`, "aria-hidden": "true" });
  chart.series.forEach((series, index) => {
    let path = "";
    let pen = "M";
    for (const [x, y] of points[index] ?? []) {
      if (x === null || y === null) { pen = "M"; continue; }
      path += `${pen}${x} ${-y}`;
      pen = "L";
    }
    const dashes = series.dashes ?? "none";
    svg.append(element("path", { d: path, fill: "none", stroke: color(series.color), "stroke-width": 1.6, "vector-effect": "non-scaling-stroke", "stroke-dasharray": dashes }));
  });
  const y = -low + 1.6 * margin;
  svg.append(element("path", { d: `M${left} ${y}h${bar}`, stroke: variable("--ink"), "stroke-width": 2, "vector-effect": "non-scaling-stroke" }));
  const names = chart.series.filter((series) => series.name).map((series) => {
    const sample = make("i", { class: series.dashes ? "sample dashed" : "sample" });
    sample.style.borderColor = color(series.color);
    return make("span", {}, sample, series.name);
  });
  const frame = make("div", { class: "shape" });
  frame.append(svg, make("div", { class: "names" }, make("span", {}, `bar: ${significant(bar)} mm`), ...names));
  return frame;
}
