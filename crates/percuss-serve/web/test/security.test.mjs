// What a browser makes of the security headers: every response has them, and foreign scripts, frames and readers get nothing.
import assert from "node:assert/strict";
import { createServer } from "node:http";
import { test } from "node:test";
import { launch, open } from "./support.mjs";

const EVERYWHERE = {
  "x-content-type-options": "nosniff",
  "referrer-policy": "no-referrer",
  "x-frame-options": "DENY",
  "cross-origin-opener-policy": "same-origin",
  "cross-origin-resource-policy": "same-origin",
};

// A page of another origin.
async function foreign(html) {
  const server = createServer((_, response) => response.writeHead(200, { "content-type": "text/html" }).end(html));
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return { server, address: `http://127.0.0.1:${server.address().port}` };
}

test("every response has the security headers", async () => {
  const shown = await open();
  const seen = new Map();
  shown.on("response", (response) => seen.set(new URL(response.url()).pathname, response.headers()));
  await shown.reload();
  await shown.locator("#comparison-body table").waitFor();
  const missing = await shown.request.get(new URL("/nowhere", shown.url()).href, { failOnStatusCode: false });
  seen.set("/nowhere", missing.headers());
  const refused = await shown.request.post(new URL("/api/answer", shown.url()).href, { data: "{", failOnStatusCode: false });
  assert.ok(refused.status() >= 400);
  seen.set("refused", refused.headers());
  assert.ok(seen.size >= 5, [...seen.keys()].join(" "));
  for (const [path, headers] of seen) {
    for (const [name, value] of Object.entries(EVERYWHERE)) assert.equal(headers[name], value, `${path}: ${name}`);
    const policy = headers["content-security-policy"];
    assert.match(policy, /default-src 'none'/, path);
    assert.match(policy, /frame-ancestors 'none'/, path);
    assert.doesNotMatch(policy, /unsafe-eval|\*/, path);
    assert.equal(headers["access-control-allow-origin"], undefined, path);
    assert.equal(headers["set-cookie"], undefined, path);
  }
  await shown.context().close();
});

test("a script that is put into the page does not run", async () => {
  const page = await open();
  const ran = await page.evaluate(async () => {
    const blocked = new Promise((resolve) => document.addEventListener("securitypolicyviolation", (event) => resolve(event.violatedDirective)));
    const script = document.createElement("script");
    script.textContent = "window.injected = true";
    document.body.append(script);
    return { injected: window.injected ?? false, directive: await blocked };
  });
  assert.equal(ran.injected, false);
  assert.match(ran.directive, /^script-src/);
  const evaluated = await page.evaluate(() => {
    const element = document.createElement("div");
    element.innerHTML = "<img src=x onerror='window.injected = true'>";
    document.body.append(element);
    return new Promise((resolve) => setTimeout(() => resolve(window.injected ?? false), 300));
  });
  assert.equal(evaluated, false);
  await page.context().close();
});

test("a page of another origin gets neither a frame nor an answer", async () => {
  const page = await open();
  const { origin } = new URL(page.url());
  await page.context().close();
  const { server, address } = await foreign(`<iframe src="${origin}/"></iframe><img src="${origin}/">`);
  const browser = await launch();
  try {
    const other = await browser.newPage();
    await other.goto(address);
    const frame = other.frames().find((found) => found !== other.mainFrame());
    assert.ok(!(await frame.content()).includes("percuss"), "it is framed");
    const read = await other.evaluate(async (from) => {
      const tried = [
        fetch(from + "/").then((response) => response.text()),
        fetch(from + "/api/answer", { method: "POST", headers: { "content-type": "application/json" }, body: "{}" }).then((r) => r.text()),
        fetch(from + "/api/answer", { method: "POST", mode: "no-cors", body: "{}" }).then((r) => r.text()),
      ];
      return (await Promise.allSettled(tried)).map((end) => (end.status === "fulfilled" ? end.value : ""));
    }, origin);
    assert.deepEqual(read, ["", "", ""]);
  } finally {
    await browser.close();
    server.close();
  }
});
