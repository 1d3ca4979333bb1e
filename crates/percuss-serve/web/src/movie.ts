// Films as files: a picture, a video by the browser's own encoder, a GIF.
/*! gifenc, https://github.com/mattdesl/gifenc, (c) 2017 Matt DesLauriers, MIT license */

import { GIFEncoder, applyPalette, quantize } from "gifenc";
import { download } from "./dom";

// Pictures per second.
export const RATE = 25;
// How long the last picture of a GIF stays [ms].
const LAST_MS = 2500;
// Types of videos, the first that the browser can write.
const TYPES: [string, string][] = [["video/webm;codecs=vp9", "webm"], ["video/webm", "webm"], ["video/mp4", "mp4"]];

// Draws picture `index` of `count` on a canvas.
export interface Reel { canvas: HTMLCanvasElement; count: number; draw(index: number): void }
export type Report = (part: number) => boolean;

export const videoType = (): [string, string] | null =>
  typeof MediaRecorder === "undefined" ? null : (TYPES.find(([type]) => MediaRecorder.isTypeSupported(type)) ?? null);

const pause = (time: number) => new Promise<void>((done) => setTimeout(done, time));

export async function picture({ canvas }: Reel, name: string): Promise<boolean> {
  const content = await new Promise<Blob | null>((done) => canvas.toBlob(done, "image/png"));
  if (content) download(`${name}.png`, content, "image/png");
  return content !== null;
}

// Records all pictures at their speed, for as long as `report` says so. Whether there is a file, as of the other two.
export async function video({ canvas, count, draw }: Reel, name: string, report: Report): Promise<boolean> {
  const kind = videoType();
  if (!kind) return false;
  draw(0);
  const stream = canvas.captureStream(RATE);
  const recorder = new MediaRecorder(stream, { mimeType: kind[0], videoBitsPerSecond: 8e6 });
  const parts: Blob[] = [];
  recorder.addEventListener("dataavailable", (event) => parts.push(event.data));
  const ended = new Promise((done) => recorder.addEventListener("stop", done));
  recorder.start();
  const began = performance.now();
  let wanted = true;
  for (let index = 0; index < count && wanted; index++) {
    draw(index);
    wanted = report(index / count);
    // Drawing takes a part of the time of a picture.
    await pause(Math.max(0, began + ((index + 1) * 1000) / RATE - performance.now()));
  }
  recorder.stop();
  await ended;
  stream.getTracks().forEach((track) => track.stop());
  const type = kind[0].split(";")[0] ?? kind[0];
  if (wanted) download(`${name}.${kind[1]}`, new Blob(parts, { type }), type);
  return wanted;
}

export async function gif({ canvas, count, draw }: Reel, name: string, report: Report): Promise<boolean> {
  const context = canvas.getContext("2d", { willReadFrequently: true });
  if (!context) return false;
  const encoder = GIFEncoder();
  const { width, height } = canvas;
  for (let index = 0; index < count; index++) {
    draw(index);
    const { data } = context.getImageData(0, 0, width, height);
    const palette = quantize(data, 256);
    const delay = index + 1 === count ? LAST_MS : 1000 / RATE;
    encoder.writeFrame(applyPalette(data, palette), width, height, { palette, delay });
    if (!report(index / count)) return false;
    await pause(0);
  }
  encoder.finish();
  download(`${name}.gif`, encoder.bytes() as BlobPart, "image/gif");
  return true;
}
