// Builds the pages into a folder: a script of each, one style sheet and the pages themselves.
import { copyFileSync, mkdirSync } from "node:fs";
import { build } from "esbuild";

const out = process.argv[2] ?? "dist";
mkdirSync(out, { recursive: true });
await build({
  entryPoints: { app: "src/main.ts", materials: "src/materials.ts" },
  outdir: out,
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  charset: "utf8",
  legalComments: "eof",
});
for (const page of ["index.html", "materials.html"]) copyFileSync(`src/${page}`, `${out}/${page}`);
