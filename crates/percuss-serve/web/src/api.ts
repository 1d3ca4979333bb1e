// Requests to the server of the page.

import type { Problem } from "./types";

export class Refused extends Error {
  constructor(readonly problem: Problem, readonly body: Record<string, unknown>) {
    super(problem.message);
  }
}

export const lost: Problem = {
  message: "the server does not respond",
  help: "check that `percuss serve` is running at this address, then try again",
  key: "",
  place: null,
};

export async function send(path: string, body: unknown, signal?: AbortSignal): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(path, {
      method: "POST",
      headers: { "content-type": "application/json" },
      body: JSON.stringify(body),
      ...(signal ? { signal } : {}),
    });
  } catch (error) {
    if (signal?.aborted) throw error;
    throw new Refused(lost, {});
  }
  if (response.ok) return response;
  const refusal = (await response.json().catch(() => ({}))) as Record<string, unknown>;
  throw new Refused((refusal["problem"] as Problem | undefined) ?? lost, refusal);
}

export async function post<T>(path: string, body: unknown, signal?: AbortSignal): Promise<T> {
  return (await (await send(path, body, signal)).json()) as T;
}

export async function postForFile(path: string, body: unknown): Promise<Blob> {
  return (await send(path, body)).blob();
}

// Computation with progress: lines of JSON, the last one with the result.
export async function follow<T>(
  path: string,
  body: unknown,
  signal: AbortSignal,
  progress: (fraction: number, words: string) => void,
): Promise<T> {
  const response = await send(path, body, signal);
  const reader = response.body?.pipeThrough(new TextDecoderStream()).getReader();
  let rest = "";
  while (reader) {
    const { value, done } = await reader.read().catch((error: unknown) => {
      if (signal.aborted) throw error;
      throw new Refused(lost, {});
    });
    if (done) break;
    const lines = (rest + value).split("\n");
    rest = lines.pop() ?? "";
    for (const line of lines) {
      const message = JSON.parse(line) as {
        progress?: { fraction: number; words: string };
        done?: T;
        problem?: Problem;
      };
      if (message.progress) progress(message.progress.fraction, message.progress.words);
      if (message.problem) throw new Refused(message.problem, {});
      if (message.done !== undefined) return message.done;
    }
  }
  throw new Refused(lost, {});
}
