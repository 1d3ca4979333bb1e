// Error with its place and remedy.

import { make } from "./dom";
import type { Problem } from "./types";

export function explained(problem: Problem): HTMLElement[] {
  const said: HTMLElement[] = [make("strong", {}, problem.message)];
  if (problem.place) {
    const { line, text: content, column, length } = problem.place;
    const pointer = `${" ".repeat(column)}${"^".repeat(length)} ${problem.key}`;
    said.push(make("pre", { tabindex: "0" }, `line ${line}\n${content}\n${pointer}`));
  } else if (problem.key) {
    said.push(make("p", {}, problem.key));
  }
  if (problem.help) said.push(make("p", {}, problem.help));
  return said;
}
