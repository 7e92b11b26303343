// Flies in step with the wall clock, one frame after the other.

/** Most time for steps per frame, ms: what does not fit flies later than real time. */
const BUDGET_MS = 12;
/** A longer pause of the page, s, is not made up for. */
const LONGEST_PICTURE_S = 0.1;
/** Pictures over which the rate is averaged. */
const AVERAGED = 30;

export interface Flown {
  /** Time of the flight, s. */
  readonly time: number;
  readonly flying: boolean;
  step(): void;
}

export class Clock {
  playing = false;
  private last = 0;
  private wanted = 0;
  private frames: number[] = [];

  /** Flies on; `now` is the time of the frame, ms. Returns whether anything was flown. */
  fly(flown: Flown, now: number, speed: number): boolean {
    const passed = Math.min((now - this.last) / 1000, LONGEST_PICTURE_S);
    this.last = now;
    this.frames = [...this.frames.slice(-AVERAGED), now];
    if (!this.playing) return false;
    this.wanted = Math.max(this.wanted, flown.time) + passed * speed;
    const until = performance.now() + BUDGET_MS;
    let steps = 0;
    while (flown.flying && flown.time < this.wanted && performance.now() < until) {
      flown.step();
      steps += 1;
    }
    if (flown.time < this.wanted) this.wanted = flown.time;
    return steps > 0;
  }

  start(flown: Flown): void {
    this.playing = true;
    this.wanted = flown.time;
    this.last = performance.now();
  }

  /** Pictures per second. */
  rate(): number {
    const [first, last] = [this.frames[0], this.frames.at(-1)];
    return first !== undefined && last !== undefined && last > first ? ((this.frames.length - 1) * 1000) / (last - first) : 0;
  }
}
