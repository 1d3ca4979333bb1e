// Horizontal bars in named rows.

import { color } from "./colors";
import { make, significant } from "./dom";
import type { BarChart } from "./types";

export function bars(chart: BarChart): HTMLElement {
  // Texts have room beside the track, so that it ends where the bars end.
  const shown = chart.rows.flatMap((row) => row.bars.flatMap((bar) => [...bar.ends, ...(bar.interval ?? [])]));
  const all = [...shown, ...chart.marks.map((mark) => mark.value)];
  const low = Math.min(...all);
  const high = Math.max(...all) > low ? Math.max(...all) : low + 1;
  const part = (value: number) => (100 * (value - low)) / (high - low);
  const place = (element: HTMLElement, from: number, to: number) => {
    element.style.left = `${part(Math.min(from, to))}%`;
    element.style.width = `${Math.abs(part(to) - part(from))}%`;
    return element;
  };
  const body = make("div", { class: "rows" });
  const names = chart.colors.map(([name, hex]) => {
    const sample = make("i", { class: "swatch" });
    sample.style.background = color(hex);
    return make("span", {}, sample, name);
  });
  body.append(make("div", { class: "names" }, ...names));
  for (const row of chart.rows) {
    const track = make("div", { class: "bar-track" });
    for (const mark of chart.marks) track.append(place(make("i", { class: "mark" }), mark.value, mark.value));
    for (const bar of row.bars) {
      const [start, end] = bar.ends;
      const lane = (element: HTMLElement) => {
        element.style.top = `${(100 * bar.lane) / chart.lanes}%`;
        element.style.height = `${100 / chart.lanes}%`;
        return element;
      };
      const filled = lane(place(make("i", { class: "filled" }), start, end));
      filled.style.background = color(bar.color);
      track.append(filled);
      const ends = [Math.min(start, end, ...(bar.interval ?? [])), Math.max(start, end, ...(bar.interval ?? []))] as const;
      if (bar.interval) track.append(lane(place(make("i", { class: "interval" }), ...bar.interval)));
      const words = lane(make("span", { class: end < start ? "end before" : "end" }, bar.text));
      if (end < start) words.style.right = `${100 - part(ends[0])}%`;
      else words.style.left = `${part(ends[1])}%`;
      track.append(words);
    }
    body.append(make("div", { class: "bar-row" }, row.name, track));
  }
  const marks = chart.marks.filter((mark) => mark.name).map((mark) => `${mark.name}: ${significant(mark.value)}`);
  const label = [chart.x.label, ...marks].join("; dashed: ");
  body.append(make("div", { class: "bar-scale" }, make("span", {}, significant(low, 3)), make("span", {}, label), make("span", {}, significant(high, 3))));
  return body;
}
