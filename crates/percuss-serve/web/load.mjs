// Many clients at once, valid and hostile: no crash, no wrong answer, no growth of memory.
//
//   PERCUSS=target/release/percuss node crates/percuss-serve/web/load.mjs --clients 200 --seconds 30
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import http from "node:http";
import net from "node:net";
import { join } from "node:path";
import { setTimeout as pause } from "node:timers/promises";
import { parseArgs } from "node:util";
import { program, root, serve } from "./server.mjs";

const { values: given } = parseArgs({ options: { clients: { type: "string", default: "200" }, seconds: { type: "string", default: "30" } } });
const [clients, seconds] = [Number(given.clients), Number(given.seconds)];
const paper = readFileSync(join(root, "cases/paper-table1/scenario.toml"), "utf8");
const sweep = `base = "scenario.toml"
model = "chain"
design = "grid"
[[parameter]]
key = "projectile.impact_velocity"
linear = { from = "150 m/s", to = "300 m/s", count = 4 }
`;
const SPEEDS = [180, 200, 220, 240, 260];
// What memory may grow by after the first third of the time.
const GROWTH = { part: 1.15, mebibytes: 16 };

const { child, address } = await serve();
const { hostname, port } = new URL(address);
const known = new Map();
const seen = new Map();
let wrong = [];

// An HTTP request; status 0 when the server closed the connection.
function send(agent, method, path, body, headers = {}) {
  return new Promise((done) => {
    const request = http.request({ hostname, port, method, path, agent, headers: { "content-type": "application/json", ...headers } }, (response) => {
      const parts = [];
      response.on("data", (part) => parts.push(part));
      response.on("end", () => done({ status: response.statusCode, body: Buffer.concat(parts) }));
      response.on("error", () => done({ status: 0, body: Buffer.alloc(0) }));
    });
    request.on("error", () => done({ status: 0, body: Buffer.alloc(0) }));
    request.end(body);
  });
}

// Bytes as they are; what comes back, if anything. Without patience the client goes away at once.
function raw(bytes, patient) {
  return new Promise((done) => {
    const socket = net.connect(Number(port), hostname, () => {
      socket.write(bytes);
      if (!patient) setTimeout(() => socket.destroy(), 5);
    });
    let said = "";
    socket.on("data", (part) => (said += part.toString("latin1")));
    socket.on("error", () => undefined);
    socket.on("close", () => done({ status: Number(/^HTTP\/1\.1 (\d+)/.exec(said)?.[1] ?? 0), body: Buffer.from(said) }));
  });
}

const asked = (speed) => JSON.stringify({ name: "shot", case: paper, model: "chain", edits: [{ key: "projectile.impact_velocity", value: `"${speed} m/s"` }] });
const post = (path, body, more = "") =>
  `POST ${path} HTTP/1.1\r\nHost: ${hostname}:${port}\r\nContent-Type: application/json\r\nConnection: close\r\n${more}Content-Length: ${Buffer.byteLength(body)}\r\n\r\n${body}`;

// A kind of request, how often it is made, and the answers that are right. 503 is a clear answer to one more run than there is place for.
const kinds = [
  ["answer", 8, [200, 503], async (agent, draw) => {
    const speed = SPEEDS[draw(SPEEDS.length)];
    const answer = await send(agent, "POST", "/api/answer", asked(speed));
    if (answer.status === 200) check(`${speed} m/s`, JSON.stringify(JSON.parse(answer.body).results));
    return answer;
  }],
  ["page", 2, [200], (agent) => send(agent, "GET", "/")],
  ["script", 2, [200], (agent) => send(agent, "GET", "/assets/app.js")],
  ["material", 1, [200], (agent) => send(agent, "GET", "/materials/copper")],
  ["case that is not valid", 2, [422, 503], (agent) => send(agent, "POST", "/api/answer", JSON.stringify({ case: paper.replace('"4.8 mm"', '"4.8 kg"') }))],
  ["no JSON", 1, [400], (agent) => send(agent, "POST", "/api/answer", "{".repeat(5000))],
  ["unknown path", 1, [404], (agent) => send(agent, "GET", "/assets/..%2f..%2fCargo.toml")],
  ["other site", 1, [403], (agent) => send(agent, "POST", "/api/answer", asked(200), { origin: "https://attacker.example" })],
  ["other host", 1, [421], () => raw("GET / HTTP/1.1\r\nHost: attacker.example\r\nConnection: close\r\n\r\n", true)],
  ["too large", 1, [413, 0], () => raw(post("/api/answer", " ".repeat(600_000)), true)],
  ["no HTTP", 1, [400, 0], () => raw(Buffer.from([22, 3, 1, 2, 0, 1, 0, 13, 10, 13, 10]), true)],
  ["half a request", 1, [0], () => raw(post("/api/answer", asked(200)).slice(0, 120), false)],
  ["sweep", 1, [200, 503], async (agent) => {
    const answer = await send(agent, "POST", "/api/study/sweep", JSON.stringify({ name: "shot", case: paper, sweep }));
    const rows = answer.status === 200 ? JSON.parse(answer.body.toString().trim().split("\n").at(-1)).done?.files["rows.csv"] : null;
    if (answer.status === 200) check("sweep", rows ?? "no rows");
    return answer;
  }],
  ["sweep that is not valid", 1, [200, 503], (agent) => send(agent, "POST", "/api/study/sweep", JSON.stringify({ case: paper, sweep: sweep.replaceAll("m/s", "kg") }))],
  ["answer not waited for", 2, [0, 200, 503], () => raw(post("/api/answer", asked(210)), false)],
  ["sweep not waited for", 1, [0, 200, 503], () => raw(post("/api/study/sweep", JSON.stringify({ case: paper, sweep: sweep.replace("= 4 ", "= 4000 ") })), false)],
  ["refinement not waited for", 1, [0, 200], () => raw(post("/api/refinement", asked(220)), false)],
  ["study not waited for", 1, [0, 200, 503], () => raw(post("/api/study/converge", asked(230)), false)],
];

// The same case has the same numbers, whatever goes on around it.
function check(what, results) {
  const before = known.get(what) ?? results;
  known.set(what, before);
  if (before !== results) wrong.push(`another result of ${what}`);
}

// Numbers that look random and are the same in every run.
function generator(seed) {
  let state = seed * 2654435761 + 1;
  return (limit) => {
    state = (Math.imul(state ^ (state >>> 15), 2246822519) + 374761393) >>> 0;
    return state % limit;
  };
}

async function client(number, until) {
  const draw = generator(number + 1);
  const agent = new http.Agent({ keepAlive: true, maxSockets: 1 });
  const bag = kinds.flatMap((kind) => Array(kind[1]).fill(kind));
  while (performance.now() < until) {
    const [name, , right, make] = bag[draw(bag.length)];
    const start = performance.now();
    const { status } = await make(agent, draw);
    const record = seen.get(name) ?? { times: [], statuses: new Map() };
    seen.set(name, record);
    record.times.push(performance.now() - start);
    record.statuses.set(status, (record.statuses.get(status) ?? 0) + 1);
    if (!right.includes(status)) wrong.push(`${name}: ${status}`);
  }
  agent.destroy();
}

const resident = () => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${child.pid}/status`, "utf8"))[1]) / 1024;
const processor = () => {
  const fields = readFileSync(`/proc/${child.pid}/stat`, "utf8").split(") ")[1].split(" ");
  return (Number(fields[11]) + Number(fields[12])) / 100;
};
const quantile = (sorted, part) => sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))];

try {
  for (const speed of SPEEDS) {
    const { status, body } = await send(undefined, "POST", "/api/answer", asked(speed));
    assert.equal(status, 200);
    check(`${speed} m/s`, JSON.stringify(JSON.parse(body).results));
  }
  const [start, used] = [performance.now(), processor()];
  const memory = [];
  const sampler = setInterval(() => memory.push([performance.now() - start, resident()]), 100);
  await Promise.all(Array.from({ length: clients }, (_, number) => client(number, start + 1000 * seconds)));
  const took = (performance.now() - start) / 1000;
  clearInterval(sampler);
  const busy = processor() - used;

  // Afterwards it is what it was.
  await pause(1000);
  assert.equal(child.exitCode, null, "the server ended");
  let last = { status: 0 };
  for (let i = 0; i < 20 && last.status !== 200; i++) last = await send(undefined, "POST", "/api/answer", asked(SPEEDS[0]));
  assert.equal(last.status, 200);
  check(`${SPEEDS[0]} m/s`, JSON.stringify(JSON.parse(last.body).results));

  const line = (name, { times, statuses }) => {
    times.sort((a, b) => a - b);
    const told = [...statuses].sort(([a], [b]) => a - b).map(([status, count]) => `${status || "closed"}: ${count}`).join(", ");
    const ms = (part) => quantile(times, part).toFixed(1).padStart(9);
    console.log(`${name.padEnd(24)}${String(times.length).padStart(8)}${ms(0.5)}${ms(0.99)}${times.at(-1).toFixed(1).padStart(9)}  ${told}`);
  };
  console.log(`${program}: ${clients} clients for ${took.toFixed(1)} s`);
  console.log(`${"request".padEnd(24)}${"count".padStart(8)}${"50 %".padStart(9)}${"99 %".padStart(9)}${"most".padStart(9)} [ms]`);
  const all = { times: [], statuses: new Map() };
  for (const [name] of kinds) {
    const record = seen.get(name);
    if (!record) continue;
    all.times.push(...record.times);
    line(name, record);
  }
  line("all", all);
  const third = memory.filter(([at]) => at < (1000 * took) / 3).map(([, size]) => size);
  const [before, peak, end] = [Math.max(...third), Math.max(...memory.map(([, size]) => size)), resident()];
  console.log(`memory [MiB]: ${before.toFixed(1)} at most in the first third, ${peak.toFixed(1)} at most, ${end.toFixed(1)} afterwards`);
  console.log(`processor time: ${busy.toFixed(1)} s, ${((1000 * busy) / all.times.length).toFixed(2)} ms a request`);
  assert.deepEqual(wrong.slice(0, 10), []);
  assert.ok(peak <= GROWTH.part * before + GROWTH.mebibytes, `memory grew from ${before} to ${peak} MiB`);
} finally {
  child.kill();
}
