// Studies, each in a tab.

import { calibration } from "./calibrate";
import { make, pairs } from "./dom";
import { panel, type Kind, type Page, type Views } from "./panel";
import type { Numbers } from "./parameters";
import { sweep } from "./sweep";
import { convergence, limits } from "./tables";
import { tabs } from "./tabs";
import type { Answer, Convergence, Limits } from "./types";
import { uncertainty } from "./uncertain";

function speed(label: string, value: number): [HTMLElement, HTMLInputElement] {
  const input = make("input", { type: "number", min: "0", max: "10000", step: "any", value: String(value) });
  return [make("label", {}, `${label} `, input), input];
}

export function studies(page: Page, numbers: Numbers, views: Views): HTMLElement[] {
  const asked = () => page.request();
  const [from, fromInput] = speed("from", 100);
  const [to, toInput] = speed("to", 1000);
  const kinds: Kind[] = [
    {
      title: "Models versus velocity",
      about: "all models at 25 impact velocities",
      path: "/api/study/compare",
      ofAllModels: true,
      inputs: [from, to, make("span", {}, "m/s")],
      body: () => ({ ...asked(), model: null, speeds: [Number(fromInput.value), Number(toInput.value), 25] }),
      show: () => [],
    },
    {
      title: "Convergence",
      about: "the selected model on four meshes, each twice as fine as the previous one",
      path: "/api/study/converge",
      body: asked,
      show: (done) => convergence(done as Convergence),
    },
    {
      title: "Ballistic limit",
      about: "impact velocity above which the target is perforated, with all applicable models",
      path: "/api/study/limit",
      ofAllModels: true,
      body: () => ({ ...asked(), model: null }),
      show: (done) => limits(done as Limits),
      example: {
        name: "weldox-460e-12mm-blunt",
        about: "A blunt projectile on a steel plate of 12 mm, with its measured limit.",
        suits: (done) => (done as Limits).limits.results.every((limit) => limit.outcome !== "found"),
        refusal: /no model gives a result/,
      },
    },
    sweep(page, numbers),
    uncertainty(page),
    calibration(page, numbers),
    {
      title: "Axisymmetric reference",
      about: "the model axi on the mesh of the case: a second to minutes",
      path: "/api/study/run",
      body: () => ({ ...asked(), model: "axi" }),
      show: (done) => (done as Answer).rows.map((rows) => make("dl", {}, ...pairs(rows))),
    },
  ];
  return tabs("Studies", kinds.map((kind) => kind.title), kinds.map((kind) => panel(kind, views, page)));
}
