// One value per row, with its range.

import { color } from "./colors";
import { make, significant } from "./dom";
import type { RowChart } from "./types";

export function rows(chart: RowChart): HTMLElement {
  const [low, high] = chart.x.range ?? [0, 1];
  const part = (value: number) => `${(100 * (value - low)) / (high - low)}%`;
  const body = make("div", { class: "rows" });
  for (const row of chart.rows) {
    const track = make("div", { class: "track" });
    for (const mark of chart.marks) {
      const line = make("i", { class: "mark" });
      line.style.left = part(mark.value);
      track.append(line);
    }
    if (row.range) {
      const whisker = make("i", { class: "whisker" });
      whisker.style.left = part(row.range[0]);
      whisker.style.right = `calc(100% - ${part(row.range[1])})`;
      whisker.style.background = color(row.color);
      track.append(whisker);
    }
    const dot = make("i", { class: "dot" });
    dot.style.left = part(row.value);
    dot.style.background = color(row.color);
    track.append(dot);
    const range = row.range ? ` (${significant(row.range[0], 3)} to ${significant(row.range[1], 3)})` : "";
    body.append(make("div", { class: "row" }, make("span", {}, row.name), track, make("span", { class: "number" }, row.words ?? significant(row.value) + range)));
  }
  body.append(make("div", { class: "scale" }, make("span", {}, significant(low, 3)), make("span", {}, chart.x.label), make("span", {}, significant(high, 3))));
  return body;
}
