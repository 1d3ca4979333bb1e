// Range and ticks of an axis.

import type uPlot from "uplot";
import type { Chart } from "./types";
import type { Range, Side } from "./zoom";

// Range of an axis; that of its values, with some room, where the axis is logarithmic and has none of its own.
export function span(chart: Chart, side: Side): Range {
  const range = chart[side].range;
  // Names of marks stand above the bars.
  if (range && chart.kind === "histogram" && side === "y") return [range[0], range[1] * (1 + 0.14 * chart.marks.length)];
  if (range) return range;
  const values = chart.kind === "lines" ? chart.series.flatMap((series) => (side === "x" ? (series.x ?? []) : series.y)) : [];
  const positive = values.filter((value): value is number => value !== null && value > 0);
  return positive.length ? [Math.min(...positive) / 1.15, Math.max(...positive) * 1.15] : [1, 10];
}

// Largest number of ticks.
const TICKS = 7;

// Names instead of numbers; on a logarithmic axis the places of the points, which are the numbers that a reader looks for.
export function ticks(chart: Chart, side: Side, current: () => Chart): uPlot.Axis {
  const { names, log } = chart[side];
  if (names) return { splits: () => names.map((_, i) => i + 1), values: () => names };
  if (!log || (side === "y" && chart.kind !== "map")) return {};
  const places = () => {
    const shown = current();
    const all = shown.kind === "lines" ? (shown.series[0]?.x ?? []).filter((x): x is number => x !== null) : even(span(shown, side));
    return all.filter((_, i) => i % Math.ceil(all.length / TICKS) === 0);
  };
  return { splits: places, filter: (_, splits) => splits };
}

// Numbers at even ratios.
function even([low, high]: Range): number[] {
  return Array.from({ length: TICKS }, (_, i) => Number((low * (high / low) ** ((i + 0.5) / TICKS)).toPrecision(2)));
}
