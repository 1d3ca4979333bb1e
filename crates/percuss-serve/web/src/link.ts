// The state of the page in the fragment of its address, which never leaves the browser.

export interface State { name: string; case: string; model: string | null }

async function through(bytes: Uint8Array, stream: CompressionStream | DecompressionStream): Promise<Uint8Array> {
  const piped = new Blob([bytes as BlobPart]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(piped).arrayBuffer());
}

export async function toFragment(state: State): Promise<string> {
  const text = new TextEncoder().encode(JSON.stringify(state));
  const packed = await through(text, new CompressionStream("deflate-raw"));
  const letters = Array.from(packed, (byte) => String.fromCharCode(byte)).join("");
  return `#s=${btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "")}`;
}

// null for an address without a readable state.
export async function fromFragment(fragment: string): Promise<State | null> {
  const packed = /^#s=([\w-]+)$/.exec(fragment)?.[1];
  if (!packed) return null;
  try {
    const letters = atob(packed.replaceAll("-", "+").replaceAll("_", "/"));
    const bytes = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
    const text = new TextDecoder().decode(await through(bytes, new DecompressionStream("deflate-raw")));
    const state = JSON.parse(text) as Partial<State>;
    if (typeof state.case !== "string") return null;
    return { name: String(state.name ?? ""), case: state.case, model: state.model ? String(state.model) : null };
  } catch {
    return null;
  }
}
