// Inputs that jump at given times: the manoeuvres of the examples.

export interface Manoeuvre {
  inputs: string[];
  times: number[];
  /** Values from each time on, SI. */
  values: number[][];
}

/** From an input file of `cargo ahv fly` whose inputs are constant between jumps. */
export function parse(csv: string): Manoeuvre {
  const [head, ...rows] = csv.trim().split('\n').map((line) => line.split(','));
  const numbers = rows.map((row) => row.map(Number));
  const values = numbers.map((row) => row.slice(1));
  const ramp = numbers.findIndex(
    (row, i) => i > 0 && row[0] !== numbers[i - 1]![0] && String(values[i]) !== String(values[i - 1]),
  );
  if (ramp > 0) throw new Error(`inputs change between ${numbers[ramp - 1]![0]} and ${numbers[ramp]![0]} s`);
  return { inputs: head!.slice(1), times: numbers.map((row) => row[0]!), values };
}

/** Inputs from an instant on. */
export function at({ times, values }: Manoeuvre, time: number): number[] {
  return values[Math.max(0, times.findLastIndex((row) => row <= time))]!;
}

/** Time of the last jump, s. */
export function end({ times }: Manoeuvre): number {
  return times.at(-1)!;
}
