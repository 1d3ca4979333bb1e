// Sections of particles as pixels: the half beyond the axis, of which the other half is the mirror image.

import { LENGTHS, type Frame } from "./film";
import type { FieldQuantity, Plan } from "./types";

// Gaps between particles of one body are closed up to this many cells: stretched material has no holes.
const CLOSED = 1.5;
// Index of pixels without a body; bodies count from 1.
const NOTHING = 0;

// Pixels per mm, and the depth of the first row [mm].
export interface Place { scale: number; top: number }

const packed = (hex: string) => {
  const [r, g, b] = [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16)) as [number, number, number];
  return (255 << 24) | (b << 16) | (g << 8) | r;
};

// Index of the colour of a body: layers take theirs in turn.
const bodyColor = (body: number, colors: number) => (body === 0 ? 0 : 1 + ((body - 1) % (colors - 1)));

export class Raster {
  readonly canvas = document.createElement("canvas");
  private bodies = new Uint8Array(0);
  private levels = new Uint8Array(0);
  private last = new Int32Array(0);
  private image: ImageData | null = null;

  constructor(private plan: Plan) {}

  draw(frame: Frame, quantity: number, range: [number, number], place: Place, columns: number, rows: number): HTMLCanvasElement {
    this.resize(columns, rows);
    this.bodies.fill(NOTHING);
    const starts = frame.head.bodies.map((_, i, all) => all.slice(0, i).reduce((sum, own) => sum + own.particles, 0));
    const kind = this.plan.quantities[quantity] as FieldQuantity;
    // The projectile comes last and covers what it touches.
    for (let body = frame.head.bodies.length - 1; body >= 0; body--) {
      const start = starts[body] ?? 0;
      this.fill(frame, body, [start, start + (frame.head.bodies[body]?.particles ?? 0)], LENGTHS + quantity, range, kind, place);
    }
    const reach = Math.round(CLOSED * frame.head.cell_mm * place.scale);
    this.closeRows(reach);
    this.closeColumns(reach);
    this.color(kind, place);
    return this.canvas;
  }

  private resize(columns: number, rows: number): void {
    if (this.image?.width === columns && this.image.height === rows) return;
    this.canvas.width = columns;
    this.canvas.height = rows;
    this.bodies = new Uint8Array(columns * rows);
    this.levels = new Uint8Array(columns * rows);
    this.last = new Int32Array(columns);
    this.image = new ImageData(columns, rows);
  }

  // Fills the sections of the particles of a body.
  private fill(frame: Frame, body: number, [from, to]: [number, number], column: number, range: [number, number], kind: FieldQuantity, { scale, top }: Place): void {
    const image = this.image as ImageData;
    const read = (index: number) => {
      const [low, high] = frame.head.scales[index] as [number, number];
      return { integers: frame.columns[index] as Uint16Array, low, step: (high - low) / 65535 };
    };
    const [radius, depth, width, height, value] = [read(0), read(1), read(2), read(3), read(column)] as const;
    const bands = kind.colors.length;
    const part = 1 / (range[1] - range[0]);
    for (let i = from; i < to; i++) {
      const r = radius.low + radius.step * (radius.integers[i] as number);
      const z = depth.low + depth.step * (depth.integers[i] as number) - top;
      const w = 0.5 * (width.low + width.step * (width.integers[i] as number));
      const h = 0.5 * (height.low + height.step * (height.integers[i] as number));
      const left = Math.max(0, Math.round((r - w) * scale));
      const right = Math.min(image.width, Math.max(left + 1, Math.round((r + w) * scale)));
      const first = Math.max(0, Math.round((z - h) * scale));
      const end = Math.min(image.height, Math.max(first + 1, Math.round((z + h) * scale)));
      if (left >= right || first >= end) continue;
      const share = (value.low + value.step * (value.integers[i] as number) - range[0]) * part;
      const level = share < kind.bare ? bands : Math.min(bands - 1, Math.max(0, Math.floor(share * bands)));
      for (let row = first; row < end; row++) {
        const at = row * image.width;
        this.bodies.fill(body + 1, at + left, at + right);
        this.levels.fill(level, at + left, at + right);
      }
    }
  }

  private closeRows(reach: number): void {
    const { width, height } = this.image as ImageData;
    const { bodies, levels } = this;
    for (let start = 0; start < width * height; start += width) {
      // On the axis a gap goes on in the mirror image.
      let before = -1;
      for (let at = start; at < start + width; at++) {
        const body = bodies[at] as number;
        if (body === NOTHING) continue;
        const gap = at - (before < 0 ? start : before + 1);
        if (gap > 0 && (before < 0 ? 2 * gap <= reach : gap <= reach && bodies[before] === body)) {
          const middle = before < 0 ? start : at - (gap >> 1);
          for (let hole = at - gap; hole < at; hole++) {
            bodies[hole] = body;
            levels[hole] = levels[hole < middle ? before : at] as number;
          }
        }
        before = at;
      }
    }
  }

  private closeColumns(reach: number): void {
    const { width, height } = this.image as ImageData;
    const { bodies, levels, last } = this;
    last.fill(-1);
    for (let row = 0; row < height; row++) {
      for (let column = 0; column < width; column++) {
        const at = row * width + column;
        const body = bodies[at] as number;
        if (body === NOTHING) continue;
        const before = last[column] as number;
        last[column] = row;
        const gap = row - before - 1;
        if (before < 0 || gap === 0 || gap > reach || bodies[before * width + column] !== body) continue;
        for (let hole = before + 1; hole < row; hole++) {
          bodies[hole * width + column] = body;
          levels[hole * width + column] = levels[(hole - before <= gap >> 1 ? before : row) * width + column] as number;
        }
      }
    }
  }

  private color(kind: FieldQuantity, { scale, top }: Place): void {
    const image = this.image as ImageData;
    const { width, height } = image;
    const { bodies, levels } = this;
    const pixels = new Uint32Array(image.data.buffer);
    const bands = kind.colors.map(packed);
    const plain = this.plan.bodies.map(packed);
    const [edge, wall] = [packed(this.plan.edge), this.plan.wall === null ? 0 : packed(this.plan.wall)];
    for (let row = 0, at = 0; row < height; row++) {
      const empty = row / scale + top > 0 ? wall : 0;
      for (let column = 0; column < width; column++, at++) {
        const body = bodies[at] as number;
        if (body === NOTHING) {
          pixels[at] = empty;
          continue;
        }
        const isEdge =
          (column + 1 < width && bodies[at + 1] !== body) || (column > 0 && bodies[at - 1] !== body) ||
          (row + 1 < height && bodies[at + width] !== body) || (row > 0 && bodies[at - width] !== body);
        const level = levels[at] as number;
        pixels[at] = isEdge ? edge : (bands[level] ?? (plain[bodyColor(body - 1, plain.length)] as number));
      }
    }
    this.canvas.getContext("2d")?.putImageData(image, 0, 0);
  }
}
