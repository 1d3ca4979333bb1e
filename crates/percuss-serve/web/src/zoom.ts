// Zoom of a chart by a dragged rectangle or keys; a double click or a button resets it.

export type Range = [number, number];
export type Side = "x" | "y";

// Part of the range that a key moves or leaves out.
const STEP = 0.2;

export interface Whole { range(side: Side): Range; log(side: Side): boolean }

export class Zoom {
  private shown: Record<Side, Range> | null = null;

  constructor(private whole: Whole, private changed: () => void) {}

  get active(): boolean {
    return this.shown !== null;
  }

  range(side: Side): Range {
    return this.shown?.[side] ?? this.whole.range(side);
  }

  reset(): void {
    if (!this.shown) return;
    this.shown = null;
    this.changed();
  }

  // Shows a rectangle; one without an extent is none.
  show(x: Range, y: Range): void {
    if (!(x[1] > x[0] && y[1] > y[0])) return;
    this.shown = { x, y };
    this.changed();
  }

  // What a key does; false for a key that does nothing here.
  key(key: string): boolean {
    switch (key) {
      case "+": case "=": this.change(STEP, -STEP, STEP, -STEP); return true;
      case "-": case "_": this.out(); return true;
      case "ArrowLeft": return this.move(-STEP, 0);
      case "ArrowRight": return this.move(STEP, 0);
      case "ArrowDown": return this.move(0, -STEP);
      case "ArrowUp": return this.move(0, STEP);
      case "0": case "Escape": {
        const was = this.active;
        this.reset();
        return was;
      }
      default: return false;
    }
  }

  // As far out as a step in goes in; at the end all of the chart is shown again.
  private out(): void {
    if (!this.shown) return;
    const part = STEP / (1 - 2 * STEP);
    this.change(-part, part, -part, part);
    const inside = (["x", "y"] as const).every((side) => {
      const [low, high] = this.whole.range(side);
      const [from, to] = this.range(side);
      return from <= low && to >= high;
    });
    if (inside) this.reset();
  }

  private move(x: number, y: number): boolean {
    if (this.shown) this.change(x, x, y, y);
    return this.active;
  }

  // Moves the ends by parts of the range.
  private change(left: number, right: number, bottom: number, top: number): void {
    this.show(this.moved("x", left, right), this.moved("y", bottom, top));
  }

  private moved(side: Side, start: number, end: number): Range {
    const log = this.whole.log(side);
    const [low, high] = this.range(side).map((value) => (log ? Math.log(value) : value)) as Range;
    const ends: Range = [low + start * (high - low), high + end * (high - low)];
    return log ? (ends.map(Math.exp) as Range) : ends;
  }
}
