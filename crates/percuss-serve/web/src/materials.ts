// Filter of the table of materials.

import { get } from "./dom";
import { holds } from "./words";

const words = get<HTMLInputElement>("words");
const group = get<HTMLSelectElement>("group");
const [from, to] = [get<HTMLInputElement>("from"), get<HTMLInputElement>("to")];
const rows = [...get("materials").querySelectorAll<HTMLTableRowElement>("tbody tr")];

// Whether a row is within the range of hardness; one without a hardness is left out where there is a range.
function isHard({ dataset }: HTMLTableRowElement): boolean {
  if (from.value === "" && to.value === "") return true;
  const hardness = Number.parseFloat(dataset["hardness"] ?? "");
  return hardness >= Number(from.value || 0) && hardness <= Number(to.value || Infinity);
}

function filter(): void {
  for (const row of rows) {
    const inGroup = group.value === "" || row.dataset["group"] === group.value;
    row.hidden = !(inGroup && isHard(row) && holds(row.dataset["words"] ?? "", words.value));
  }
  const shown = rows.filter((row) => !row.hidden).length;
  get("count").textContent = shown === rows.length ? `${shown} materials` : `${shown} of ${rows.length} materials`;
}

const form = get<HTMLFormElement>("filter");
form.addEventListener("submit", (event) => event.preventDefault());
form.addEventListener("input", filter);
form.hidden = false;
// What the browser has kept of an earlier visit counts too.
filter();
