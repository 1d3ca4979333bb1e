// The axisymmetric answer of a case, refined as long as nothing changes.

import { Refused } from "./api";
import { get } from "./dom";
import { Estimate } from "./estimate";
import { Impact } from "./impact";
import { messages } from "./messages";
import type { Answer, Problem, RefinementMessage } from "./types";

// Time without a change after which it begins [ms].
const REST_MS = 200;
const PATH = "/api/refinement";

export interface Asked { name: string; case: string }

export class Refinement {
  readonly impact: Impact;
  private estimate = new Estimate();
  private control: AbortController | null = null;
  private timer = 0;
  // The case that is refined, or was; null after a change.
  private text: string | null = null;

  // `heard` is called after each mesh.
  constructor(name: () => string, follow: (time: number | null, rests: boolean) => void, private heard: () => void) {
    this.impact = new Impact(name, follow);
    get("side").prepend(this.estimate.element);
    get("seen").append(this.impact.element);
    addEventListener("pagehide", () => this.stop());
  }

  // Refines the answer of a case, unless that has been begun; the result of a model stands beside it.
  follow(asked: Asked, beside: Pick<Answer, "model" | "results">): void {
    this.estimate.follow(beside);
    if (asked.case === this.text) return;
    this.stop();
    this.text = asked.case;
    this.timer = window.setTimeout(() => void this.run(asked), REST_MS);
  }

  // Shows how many warnings the one-dimensional run has.
  warn(count: string | null, model: string): void {
    this.estimate.warn(count, model);
  }

  // Name and number of the answer so far.
  get answer(): [string, string] | null {
    return this.estimate.answer;
  }

  // Whether a case is the one that is refined.
  has(text: string): boolean {
    return text === this.text;
  }

  // Ends it here and in the server.
  stop(): void {
    clearTimeout(this.timer);
    this.control?.abort();
    if (this.text === null) return;
    this.text = null;
    this.estimate.fade();
    this.impact.fade();
  }

  private async run(asked: Asked): Promise<void> {
    const own = (this.control = new AbortController());
    try {
      for await (const { head, body } of messages<RefinementMessage>(PATH, asked, own.signal)) {
        if (own.signal.aborted) return;
        this.take(head, body);
      }
    } catch (error) {
      if (own.signal.aborted) return;
      const unexpected: Problem = { message: String(error), help: "", key: "", place: null };
      this.fail(error instanceof Refused ? error.problem : unexpected);
    }
  }

  private take(message: RefinementMessage, body: ArrayBuffer): void {
    const { plan, refused, progress, frame, answer, problem, done } = message;
    if (plan) {
      this.estimate.begin(plan);
      this.impact.begin(plan);
    }
    if (refused) {
      this.estimate.none(refused.reason, refused.remedy);
      this.impact.clear();
    }
    if (progress) this.estimate.progress(progress.cells, progress.fraction);
    if (frame) this.impact.add(frame, body);
    if (answer) {
      this.estimate.add(answer);
      this.impact.end(answer.cells);
      if (answer.meshes.length === 0) this.estimate.none(answer.reason ?? "", null);
      this.heard();
    }
    if (problem) this.fail(problem);
    if (done) this.estimate.idle();
  }

  private fail(problem: Problem): void {
    if (!this.estimate.problem(problem)) this.impact.clear();
  }
}
