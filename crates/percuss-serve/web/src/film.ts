// Frames of a run on one mesh, as the server sends them.

import type { FrameHead } from "./types";

// Columns of a frame before its quantities: radius, depth, width and height of a section.
export const LENGTHS = 4;

export interface Frame { head: FrameHead; columns: Uint16Array[] }

export class Film {
  frames: Frame[] = [];
  // Whether all frames are there.
  complete = false;

  constructor(readonly cells: number) {}

  // Adds a frame; the server says which earlier ones go, so that there are never more than it allows.
  add(head: FrameHead, body: ArrayBuffer): void {
    if (head.first) this.frames = [];
    const count = head.bodies.reduce((sum, own) => sum + own.particles, 0);
    const columns = head.scales.map((_, column) => new Uint16Array(body, 2 * column * count, count));
    this.frames.push({ head, columns });
    if (head.dropped.length) this.frames = this.frames.filter((frame) => !head.dropped.includes(frame.head.number));
  }

  // Index of the last frame that is not later than a time.
  at(time: number): number {
    let [low, high] = [0, this.frames.length];
    while (low + 1 < high) {
      const middle = (low + high) >> 1;
      if ((this.frames[middle]?.head.time_us ?? 0) <= time) low = middle;
      else high = middle;
    }
    return low;
  }

  get bytes(): number {
    return this.frames.reduce((sum, frame) => sum + (frame.columns[0]?.buffer.byteLength ?? 0), 0);
  }
}
