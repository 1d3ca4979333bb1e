// Starts the program for the tests of the page.
import { spawn } from "node:child_process";
import { join, resolve } from "node:path";

export const root = resolve(import.meta.dirname, "../../..");
const target = process.env.CARGO_TARGET_DIR ?? join(root, "target");
// The program to test: that of the release build unless PERCUSS names another one.
export const program = process.env.PERCUSS ? resolve(root, process.env.PERCUSS) : join(target, "release/percuss");

// Serves on a free port; the first line says where.
export async function serve(...options) {
  const child = spawn(program, ["serve", "--port", "0", ...options], { stdio: ["ignore", "pipe", "inherit"] });
  const line = await new Promise((done, fail) => {
    let said = "";
    child.stdout.on("data", (part) => {
      said += part;
      if (said.includes("\n")) done(said);
    });
    child.on("exit", (code) => fail(new Error(`the server ended with ${code}`)));
    child.on("error", fail);
  });
  return { child, address: /http:\/\/\S+/.exec(line)[0] };
}
