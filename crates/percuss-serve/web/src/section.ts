// Picture of a frame: rod and target in section, colour bar, scale bar and time.

import { variable } from "./colors";
import { significant } from "./dom";
import type { Frame } from "./film";
import { Raster, type Place } from "./raster";
import { rounded } from "./shape";
import type { Plan } from "./types";

// Space at the right for the colour bar, its numbers and its name, and above it for time and depth [px].
const RIGHT = 104;
const ABOVE = 52;
const MARGIN = 6;
const BAR = 14;
const FONT = "system-ui, sans-serif";

// A frame, the latest of its film, and the quantity with the values of its first and last colour.
export interface Shot { frame: Frame; latest: Frame; quantity: number; range: [number, number] }
export interface Size { width: number; height: number; ratio: number }

// Multiples of a round step within a range.
function ticks([low, high]: [number, number]): [number, string][] {
  const rough = (high - low) / 5;
  const decade = 10 ** Math.floor(Math.log10(rough));
  const step = ([1, 2, 5, 10].find((factor) => factor * decade >= rough) ?? 10) * decade;
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  return Array.from({ length: last - first + 1 }, (_, i) => [(first + i) * step, ((first + i) * step).toFixed(decimals)]);
}

export class Section {
  private raster: Raster;

  constructor(private plan: Plan) {
    this.raster = new Raster(plan);
  }

  // Draws a frame with the part of the plane of the latest one, so that it stays while the film plays.
  paint(canvas: HTMLCanvasElement, { frame, latest, quantity, range }: Shot, size: Size): void {
    const { width, height, ratio } = size;
    const [across, down] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (canvas.width !== across || canvas.height !== down) [canvas.width, canvas.height] = [across, down];
    const context = canvas.getContext("2d");
    if (!context) return;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.fillStyle = variable("--card");
    context.fillRect(0, 0, width, height);
    const inner = { width: width - RIGHT - 2 * MARGIN, height: height - 2 * MARGIN };
    const place = this.bodies(context, { frame, latest, quantity, range }, inner, ratio);
    this.frame(context, inner, place);
    this.colorBar(context, quantity, range, width, height);
    this.stamp(context, frame, width);
  }

  private bodies(context: CanvasRenderingContext2D, { frame, latest, quantity, range }: Shot, inner: { width: number; height: number }, ratio: number): Place {
    const { radius_mm, depth_mm: [back, front] } = latest.head.view;
    const scale = Math.min(inner.width / (2 * radius_mm), inner.height / (front - back));
    const place = { scale, top: 0.5 * (back + front) - (0.5 * inner.height) / scale };
    // Two pixels of the raster per pixel of the page make smooth edges.
    const finer = Math.max(2, ratio);
    const half = 0.5 * inner.width;
    const [columns, rows] = [Math.ceil(half * finer), Math.ceil(inner.height * finer)];
    const image = this.raster.draw(frame, quantity, range, { ...place, scale: scale * finer }, columns, rows);
    const [drawnWidth, drawnHeight] = [columns / finer, rows / finer];
    context.save();
    context.beginPath();
    context.rect(MARGIN, MARGIN, inner.width, inner.height);
    context.clip();
    context.translate(MARGIN + half, MARGIN);
    context.drawImage(image, 0, 0, drawnWidth, drawnHeight);
    context.scale(-1, 1);
    context.drawImage(image, 0, 0, drawnWidth, drawnHeight);
    context.restore();
    return place;
  }

  // Border, axis of symmetry, original face of the target, and scale bar.
  private frame(context: CanvasRenderingContext2D, { width, height }: { width: number; height: number }, { scale, top }: Place): void {
    const ink = variable("--ink");
    context.lineWidth = 1;
    context.strokeStyle = variable("--line");
    context.strokeRect(MARGIN + 0.5, MARGIN + 0.5, width - 1, height - 1);
    context.strokeStyle = "#303038";
    context.globalAlpha = 0.55;
    context.setLineDash([9, 3, 2, 3]);
    context.beginPath();
    context.moveTo(MARGIN + 0.5 * width, MARGIN);
    context.lineTo(MARGIN + 0.5 * width, MARGIN + height);
    context.stroke();
    if (this.plan.wall === null) {
      context.setLineDash([2, 3]);
      context.beginPath();
      context.moveTo(MARGIN, MARGIN - top * scale);
      context.lineTo(MARGIN + width, MARGIN - top * scale);
      context.stroke();
    }
    context.globalAlpha = 1;
    context.setLineDash([]);
    const length = rounded(width / scale);
    const [left, y] = [MARGIN + 12, MARGIN + 24];
    const words = `${significant(length)} mm`;
    context.font = `12px ${FONT}`;
    context.fillStyle = variable("--card");
    context.globalAlpha = 0.85;
    context.fillRect(left - 7, y - 18, Math.max(length * scale, context.measureText(words).width) + 14, 27);
    context.globalAlpha = 1;
    context.strokeStyle = context.fillStyle = ink;
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(left, y - 3);
    context.lineTo(left, y + 3);
    context.moveTo(left, y);
    context.lineTo(left + length * scale, y);
    context.moveTo(left + length * scale, y - 3);
    context.lineTo(left + length * scale, y + 3);
    context.stroke();
    context.textAlign = "left";
    context.fillText(words, left, y - 6);
  }

  private colorBar(context: CanvasRenderingContext2D, quantity: number, range: [number, number], width: number, height: number): void {
    const { colors, label } = this.plan.quantities[quantity] ?? { colors: [], label: "" };
    const left = width - RIGHT + 8;
    const [top, tall] = [MARGIN + ABOVE, height - 2 * MARGIN - ABOVE - 6];
    const step = tall / colors.length;
    colors.forEach((color, level) => {
      context.fillStyle = color;
      const y = top + tall - (level + 1) * step;
      context.fillRect(left, y, BAR, step + (level === 0 ? 0 : 0.6));
    });
    context.strokeStyle = context.fillStyle = variable("--ink");
    context.lineWidth = 1;
    context.strokeRect(left + 0.5, top + 0.5, BAR - 1, tall - 1);
    context.font = `11px ${FONT}`;
    context.textAlign = "left";
    for (const [value, words] of ticks(range)) {
      const y = top + tall * (1 - (value - range[0]) / (range[1] - range[0]));
      context.fillRect(left + BAR, y - 0.5, 4, 1);
      context.fillText(words, left + BAR + 7, y + 4);
    }
    context.save();
    context.translate(width - 5, top + 0.5 * tall);
    context.rotate(-Math.PI / 2);
    context.font = `12px ${FONT}`;
    context.textAlign = "center";
    context.fillText(label, 0, 0);
    context.restore();
  }

  // Time and depth above the colour bar.
  private stamp(context: CanvasRenderingContext2D, { head }: Frame, width: number): void {
    const left = width - RIGHT + 8;
    context.fillStyle = variable("--ink");
    context.textAlign = "left";
    context.font = `bold 15px ${FONT}`;
    context.fillText(`${head.time_us.toFixed(1)} µs`, left, MARGIN + 14);
    context.font = `12px ${FONT}`;
    if (this.plan.wall === null) context.fillText(`${significant(head.depth_mm, 3)} mm deep`, left, MARGIN + 31, RIGHT - 12);
  }
}
