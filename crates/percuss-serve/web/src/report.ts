// A case and its answer as one HTML file that needs nothing else and prints to a few pages.

import { make, pairs } from "./dom";
import type { Answer } from "./types";

export interface Parts {
  name: string;
  answer: Answer;
  // Name and number of the axisymmetric answer.
  best: [string, string] | null;
  // Picture of the impact, as an address.
  impact: string | null;
  // Figures as SVG texts, with their titles.
  figures: { title: string; svg: string }[];
}

const STYLE = `body { font: 11pt/1.4 system-ui, sans-serif; max-width: 48rem; margin: 2rem auto; padding: 0 1rem; color: #1c2024; }
h1 { font-size: 1.4rem; } h2 { font-size: 1.1rem; margin: 1.4rem 0 .4rem; }
.best { font-size: 1.3rem; font-weight: 600; }
dl { display: grid; grid-template-columns: repeat(3, 1fr); gap: .4rem 1rem; } dt { font-size: .8rem; color: #55606c; } dd { margin: 0; font-weight: 600; }
.long { grid-column: 1 / -1; } .long dd { font-weight: 400; }
img { max-width: 100%; } figure { margin: 1rem 0; break-inside: avoid; } figcaption { color: #55606c; font-size: .85rem; }
pre { font: 9pt/1.35 ui-monospace, monospace; white-space: pre-wrap; background: #f3f5f7; padding: .6rem; }`;

export function report({ name, answer, best, impact, figures }: Parts): string {
  const version = answer.results.percuss_version;
  const warnings = answer.results.results[0]?.warnings ?? [];
  const picture = (address: string, title: string) => make("figure", {}, make("img", { src: address, alt: title }), make("figcaption", {}, title));
  const body = make("body", {},
    make("h1", {}, name || "case"),
    make("p", {}, `percuss ${version}, ${new Date().toISOString().slice(0, 10)}`),
    best ? make("p", { class: "best" }, `${best[0]} ${best[1]}`) : null,
    best ? make("p", {}, "Limit of fine meshes of the axisymmetric model; ± is the error of the mesh alone.") : null,
    impact ? picture(impact, "Projectile and target in section, by the axisymmetric model") : null,
    make("h2", {}, `Numbers of model ${answer.model}`),
    make("dl", {}, ...pairs(answer.rows[0])),
    warnings.length ? make("h2", {}, "Warnings") : null,
    make("ul", {}, ...warnings.map((words) => make("li", {}, words))),
    ...figures.map(({ title, svg }) => picture(`data:image/svg+xml,${encodeURIComponent(svg)}`, title)),
    make("h2", {}, "Balances and time steps"),
    make("dl", {}, ...pairs([...answer.rows[1], ...answer.rows[2]])),
    make("h2", {}, "Case file"),
    make("pre", {}, answer.case),
  );
  const head = make("head", {}, make("meta", { charset: "utf-8" }), make("title", {}, `${name || "case"}: percuss`), make("style", {}, STYLE));
  const html = make("html", { lang: "en" });
  html.append(head, body);
  return `<!doctype html>\n${html.outerHTML}\n`;
}
