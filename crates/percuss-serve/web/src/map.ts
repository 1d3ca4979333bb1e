// Colour map: its cells as an image, the colour scale, and the value under the cursor.

import type uPlot from "uplot";
import { make, significant } from "./dom";
import type { Axis, MapChart } from "./types";

// Character of the first colour.
const FIRST = "0".charCodeAt(0);
const canvas = document.createElement("canvas");

function channels(hex: string): [number, number, number] {
  const from = /^#([0-9a-f]{2})([0-9a-f]{2})([0-9a-f]{2})$/i.exec(hex);
  if (from) return [parseInt(from[1]!, 16), parseInt(from[2]!, 16), parseInt(from[3]!, 16)];
  const [r, g, b] = (hex.match(/\d+(\.\d+)?/g) ?? []).map(Number);
  return [r ?? 0, g ?? 0, b ?? 0];
}

// One pixel per cell, the row with the smallest value of y at the bottom.
export function mapCanvas(chart: MapChart, rowCount: number): HTMLCanvasElement {
  canvas.width = chart.columns;
  canvas.height = rowCount;
  const context = canvas.getContext("2d");
  if (!context) return canvas;
  const colors = chart.colors.map(channels);
  const none = channels(chart.no_value);
  const image = context.createImageData(chart.columns, rowCount);
  for (let row = 0; row < rowCount; row++) {
    for (let column = 0; column < chart.columns; column++) {
      const code = chart.cells.charCodeAt(row * chart.columns + column);
      const [r, g, b] = colors[code - FIRST] ?? none;
      const at = 4 * ((rowCount - 1 - row) * chart.columns + column);
      image.data.set([r, g, b, 255], at);
    }
  }
  context.putImageData(image, 0, 0);
  return canvas;
}

// Value of a cell, to the step of its colour.
function valueAt(chart: MapChart, x: number, y: number): number | null {
  const rowCount = chart.cells.length / chart.columns;
  // Cells are even on the axis as it is drawn.
  const part = (value: number, { log, range }: Axis) => {
    const [at, low, high] = [value, ...(range ?? [0, 1])].map((number) => (log ? Math.log(number) : number)) as [number, number, number];
    return (at - low) / (high - low);
  };
  const column = Math.min(chart.columns - 1, Math.floor(part(x, chart.x) * chart.columns));
  const row = Math.min(rowCount - 1, Math.floor(part(y, chart.y) * rowCount));
  const code = chart.cells.charCodeAt(row * chart.columns + column) - FIRST;
  if (!(code >= 0)) return null;
  const [low, high] = chart.ends;
  return low + ((high - low) * code) / (chart.colors.length - 1);
}

// Unit of a label: the text in the parentheses at its end.
function unitOf(label: string): string {
  return /\(([^()]+)\)$/.exec(label)?.[1] ?? "";
}

// Colour scale and the value under the cursor.
export function mapReader(plot: uPlot, chart: () => MapChart): HTMLElement {
  const scale = make("canvas", { width: "130", height: "1", "aria-hidden": "true" });
  const low = make("span");
  const high = make("span");
  const said = make("output");
  const draw = () => {
    const { colors, ends, value_label } = chart();
    const context = scale.getContext("2d");
    colors.forEach((color, i) => {
      if (!context) return;
      context.fillStyle = color;
      context.fillRect((i * 130) / colors.length, 0, 130 / colors.length + 1, 1);
    });
    low.textContent = significant(ends[0], 3);
    high.textContent = significant(ends[1], 3);
    said.textContent = value_label;
  };
  draw();
  (plot.hooks.setData ??= []).push(draw);
  (plot.hooks.setCursor ??= []).push(() => {
    const { left, top } = plot.cursor;
    if (left == null || top == null || left < 0 || top < 0) {
      said.textContent = chart().value_label;
      return;
    }
    const [x, y] = [plot.posToVal(left, "x"), plot.posToVal(top, "y")];
    const value = valueAt(chart(), x, y);
    const words = value === null ? "no material" : `about ${significant(value, 2)} ${unitOf(chart().value_label)}`;
    said.textContent = `${words} at ${significant(x, 3)} ${unitOf(chart().x.label)}, ${significant(y, 3)} ${unitOf(chart().y.label)}`;
  });
  return make("div", { class: "reader" }, low, scale, high, said);
}
