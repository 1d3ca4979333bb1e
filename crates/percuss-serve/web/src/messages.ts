// Binary messages of a streamed response: lengths of head and body, a head in JSON, and a body of 16-bit integers.

import { Refused, lost, send } from "./api";

export interface Message<T> { head: T; body: ArrayBuffer }

// Lengths of head and body [bytes].
const LENGTHS = 8;

function joined(first: Uint8Array<ArrayBuffer>, second: Uint8Array<ArrayBuffer>): Uint8Array<ArrayBuffer> {
  if (first.length === 0) return second;
  const all = new Uint8Array(first.length + second.length);
  all.set(first);
  all.set(second, first.length);
  return all;
}

export async function* messages<T>(path: string, asked: unknown, signal: AbortSignal): AsyncGenerator<Message<T>> {
  const response = await send(path, asked, signal);
  const reader = response.body?.getReader();
  const decoder = new TextDecoder();
  let rest: Uint8Array<ArrayBuffer> = new Uint8Array(0);
  while (reader) {
    const part = await reader.read().catch((error: unknown) => {
      if (signal.aborted) throw error;
      throw new Refused(lost, {});
    });
    if (part.done) return;
    rest = joined(rest, part.value);
    while (rest.length >= LENGTHS) {
      const lengths = new DataView(rest.buffer, rest.byteOffset, LENGTHS);
      const head = LENGTHS + lengths.getUint32(0, true);
      const end = head + lengths.getUint32(4, true);
      if (rest.length < end) break;
      const text = decoder.decode(rest.subarray(LENGTHS, head));
      yield { head: JSON.parse(text) as T, body: rest.slice(head, end).buffer };
      rest = rest.subarray(end);
    }
  }
}
