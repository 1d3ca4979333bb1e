// The impact as an animation: the frames of the finest mesh so far, a time slider, and files to take away.

import { button, make, significant } from "./dom";
import { Film, type Frame } from "./film";
import { RATE, gif, picture, video, videoType, type Reel, type Report } from "./movie";
import { Section, type Shot, type Size } from "./section";
import type { FrameHead, Plan } from "./types";

// Size of a picture on the page: width over height, and limits of the height [px].
const SHAPE = 1.5;
const HEIGHTS = [300, 470] as const;
// Sizes of files: a picture, a video, a GIF.
const FILES = { picture: { width: 960, height: 640, ratio: 2 }, video: { width: 960, height: 640, ratio: 1 }, gif: { width: 720, height: 480, ratio: 1 } };

export class Impact {
  readonly element: HTMLElement;
  private canvas = make("canvas", { role: "img" });
  private slider = make("input", { type: "range", min: "0", max: "0", step: "1", value: "0", "aria-label": "Time of the impact" });
  private play = button("Play", () => this.toggle());
  private back = button("◀", () => this.step(-1));
  private forth = button("▶", () => this.step(1));
  private quantity = make("select", { "aria-label": "Colour" });
  private own = make("input", { type: "checkbox" });
  private caption = make("figcaption");
  private body = make("div", { class: "player" });
  private files = make("span", { class: "files" });
  private state = make("span", { class: "soft", role: "status" });
  private plan: Plan | null = null;
  private section: Section | null = null;
  private shown: Film | null = null;
  private coming: Film | null = null;
  private index = 0;
  private playing = false;
  // Who has taken hold of the player keeps it: nothing plays unasked from then on.
  private unasked = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  // Time at which it rests [µs]: the end, unless another is chosen.
  private rest = Infinity;
  private started = 0;
  private request = 0;
  private painted = "";
  private recording = false;

  // `follow` hears the time shown [µs], and whether it rests there; null without frames.
  constructor(private name: () => string, private follow: (time: number | null, rests: boolean) => void) {
    this.back.setAttribute("aria-label", "One frame back");
    this.forth.setAttribute("aria-label", "One frame on");
    this.slider.addEventListener("input", () => this.show(Number(this.slider.value)));
    this.quantity.addEventListener("input", () => this.paint());
    this.own.addEventListener("input", () => this.paint());
    const controls = make("div", { class: "controls" }, this.play, this.back, this.forth, this.slider);
    const own = make("label", {}, this.own, " range of this frame");
    const choices = make("div", { class: "controls" }, make("label", {}, "Colour ", this.quantity), own, this.state, this.files);
    this.body.append(this.canvas, controls, choices);
    const head = make("div", { class: "head" }, make("h3", {}, "Impact in section"));
    this.element = make("figure", { id: "impact" }, head, this.body, this.caption);
    this.element.hidden = true;
    this.fileButtons();
    new ResizeObserver(() => this.paint()).observe(this.body);
  }

  // A new answer begins: what is shown stays, in pale colours, until its first frame is there.
  begin(plan: Plan): void {
    this.plan = plan;
    this.section = new Section(plan);
    this.coming = null;
    this.fade();
    const chosen = this.quantity.value || plan.quantities[0]?.name || "";
    this.quantity.replaceChildren(...plan.quantities.map(({ name, label }) => make("option", { value: name }, label)));
    this.quantity.value = chosen;
  }

  add(head: FrameHead, content: ArrayBuffer): void {
    const isStale = this.element.classList.contains("stale");
    if (!this.shown || isStale) {
      this.shown = new Film(head.cells);
      this.element.classList.remove("stale");
      this.element.hidden = false;
    }
    const time = this.time;
    if (this.shown.cells !== head.cells && this.coming?.cells !== head.cells) this.coming = new Film(head.cells);
    const film = this.shown.cells === head.cells ? this.shown : (this.coming as Film);
    film.add(head, content);
    if (film !== this.shown) return;
    this.extent(time);
    if (film.frames.length === 1) this.first();
    else if (!this.playing) this.paint();
  }

  // The run on a mesh has ended: its frames replace those of the coarser mesh.
  end(cells: number): void {
    if (this.coming?.cells === cells) {
      const time = this.time;
      [this.shown, this.coming] = [this.coming, null];
      this.extent(time);
      this.paint();
    }
    if (this.shown?.cells === cells) this.shown.complete = true;
    this.describe();
  }

  // The case has changed, or has no animation.
  fade(): void {
    this.pause();
    this.element.classList.toggle("stale", this.shown !== null);
    this.follow(null, true);
  }

  // There is nothing to show.
  clear(): void {
    this.fade();
    [this.shown, this.coming] = [null, null];
    this.element.hidden = true;
  }

  // Paints again, as after a change of the theme.
  draw(): void {
    this.painted = "";
    this.paint();
  }

  // The picture shown, as an address; null without one of this case.
  still(): string | null {
    return this.element.hidden || this.element.classList.contains("stale") ? null : this.canvas.toDataURL("image/png");
  }

  private get frame(): Frame | undefined {
    return this.shown?.frames[this.index];
  }

  private get time(): number {
    return this.frame?.head.time_us ?? 0;
  }

  private first(): void {
    this.element.dataset["first"] = String(performance.now());
    if (this.unasked) this.start(0);
    this.paint();
  }

  // Adapts the slider to the frames there are: where it rests, or at the time that it plays.
  private extent(time: number): void {
    this.index = this.shown?.at(this.playing ? time : this.rest) ?? 0;
    this.started = performance.now() - (1000 * this.index) / RATE;
    this.slider.max = String(Math.max(0, (this.shown?.frames.length ?? 1) - 1));
    this.slider.value = String(this.index);
    this.element.dataset["frames"] = String(this.shown?.frames.length ?? 0);
    this.element.dataset["cells"] = String(this.shown?.cells ?? 0);
    this.element.dataset["bytes"] = String((this.shown?.bytes ?? 0) + (this.coming?.bytes ?? 0));
  }

  private toggle(): void {
    this.unasked = false;
    if (this.playing) this.hold();
    else this.start(this.index >= (this.shown?.frames.length ?? 1) - 1 ? 0 : this.index);
  }

  private start(index: number): void {
    this.index = index;
    this.playing = true;
    this.play.textContent = "Pause";
    this.started = performance.now() - (1000 * this.index) / RATE;
    cancelAnimationFrame(this.request);
    this.request = requestAnimationFrame(() => this.tick());
  }

  private pause(): void {
    if (!this.playing) return;
    this.playing = false;
    this.play.textContent = "Play";
    cancelAnimationFrame(this.request);
    this.paint();
  }

  // The next picture; at the end of what is there it waits for more.
  private tick(): void {
    if (!this.playing || !this.shown) return;
    const last = this.shown.frames.length - 1;
    const due = Math.floor(((performance.now() - this.started) * RATE) / 1000);
    if (due > last) this.started = performance.now() - (1000 * last) / RATE;
    this.index = Math.min(due, last);
    this.slider.value = String(this.index);
    if (due > last && this.shown.complete) {
      this.rest = Infinity;
      return this.pause();
    }
    this.paint();
    this.request = requestAnimationFrame(() => this.tick());
  }

  private step(by: number): void {
    this.show(this.index + by);
  }

  private show(index: number): void {
    this.unasked = false;
    this.pause();
    this.index = Math.min(Math.max(0, index), (this.shown?.frames.length ?? 1) - 1);
    this.slider.value = String(this.index);
    this.hold();
    this.paint();
  }

  // Rests at the frame shown.
  private hold(): void {
    const isLast = this.index >= (this.shown?.frames.length ?? 1) - 1;
    this.rest = isLast ? Infinity : this.time;
    this.pause();
  }

  private chosen(): number {
    return Math.max(0, this.quantity.selectedIndex);
  }

  private shot(frame: Frame, latest: Frame, quantity = this.chosen(), ofFrame = this.own.checked): Shot {
    const range = ofFrame ? frame.head.own_ranges[quantity] : latest.head.ranges[quantity];
    return { frame, latest, quantity, range: range ?? [0, 1] };
  }

  private size(): Size {
    const width = Math.max(260, this.body.clientWidth);
    const height = Math.min(HEIGHTS[1], Math.max(HEIGHTS[0], Math.round(width / SHAPE)));
    return { width, height, ratio: devicePixelRatio };
  }

  private paint(): void {
    const [frame, latest] = [this.frame, this.shown?.frames.at(-1)];
    if (!frame || !latest || !this.section || this.body.clientWidth === 0) return;
    const size = this.size();
    const shot = this.shot(frame, latest);
    const key = [this.shown?.cells, frame.head.number, latest.head.number, shot.quantity, shot.range, size.width, size.ratio].join();
    if (key !== this.painted) {
      this.painted = key;
      const start = performance.now();
      this.canvas.style.height = `${size.height}px`;
      this.section.paint(this.canvas, shot, size);
      this.element.dataset["painted"] = (performance.now() - start).toFixed(1);
      this.element.dataset["time"] = frame.head.time_us.toFixed(3);
    }
    this.follow(frame.head.time_us, !this.playing);
    if (!this.playing) this.describe();
  }

  // What is to be seen, in words.
  private describe(): void {
    const frame = this.frame;
    if (!frame || !this.shown || !this.plan) return;
    const { head } = frame;
    const depth = this.plan.wall === null ? `, ${significant(head.depth_mm, 3)} mm deep` : "";
    const label = this.plan.quantities[this.chosen()]?.label ?? "";
    const particles = head.bodies.reduce((sum, body) => sum + body.particles, 0);
    this.slider.setAttribute("aria-valuetext", `${head.time_us.toFixed(1)} µs`);
    this.canvas.setAttribute("aria-label", `Projectile and target in section at ${head.time_us.toFixed(1)} µs${depth}, coloured by ${label}`);
    const { cells, frames } = this.shown;
    this.caption.textContent = `axi on ${cells} cells per radius: ${particles} particles, ${frames.length} frames. The right half is computed, the left half its mirror image.`;
  }

  // Runs a job with the frames on a canvas of its own size.
  private async take(size: Size, job: (reel: Reel, name: string, report: Report) => Promise<boolean>, stem: string): Promise<void> {
    const { shown: film, section, index } = this;
    const latest = film?.frames.at(-1);
    if (!film || !latest || !section || this.recording) return;
    const isStale = () => this.shown !== film || this.element.classList.contains("stale");
    if (isStale()) {
      this.state.textContent = "no file: this is the impact of the case before it was changed";
      return;
    }
    this.recording = true;
    let isCancelled = false;
    this.pause();
    // A file has one name, one quantity and one kind of range, whatever is chosen meanwhile.
    const [name, quantity, ofFrame] = [`${this.name()}-${stem}`, this.chosen(), this.own.checked];
    const buttons = this.files.querySelectorAll("button");
    buttons.forEach((control) => (control.disabled = true));
    const words = make("span");
    this.state.replaceChildren(words, " ", button("Cancel", () => (isCancelled = true)));
    const canvas = document.createElement("canvas");
    const draw = (at: number) => section.paint(canvas, this.shot(film.frames[at] ?? latest, latest, quantity, ofFrame), size);
    draw(index);
    const report = (part: number) => {
      words.textContent = `writing … ${Math.round(100 * part)} %`;
      return !isCancelled && !isStale();
    };
    let ending = "";
    try {
      const isThere = await job({ canvas, count: film.frames.length, draw }, name, report);
      if (!isThere) ending = isCancelled ? "cancelled" : "no file: the case was changed";
    } finally {
      this.recording = false;
      this.state.textContent = ending;
      buttons.forEach((control) => (control.disabled = false));
      this.draw();
    }
  }

  private fileButtons(): void {
    const offered: [string, string, () => Promise<void>][] = [
      ["PNG", "Download this frame as PNG", () => this.take(FILES.picture, picture, `impact-${this.time.toFixed(1)}us`)],
      ["GIF", "Download the animation as GIF", () => this.take(FILES.gif, gif, "impact")],
    ];
    const kind = videoType();
    if (kind) {
      const type = kind[1] === "webm" ? "WebM" : "MP4";
      offered.push([type, `Download the animation as ${type}`, () => this.take(FILES.video, video, "impact")]);
    }
    this.files.append("Download ");
    for (const [text, label, action] of offered) {
      const control = button(text, () => void action());
      control.setAttribute("aria-label", label);
      this.files.append(control);
    }
  }
}
