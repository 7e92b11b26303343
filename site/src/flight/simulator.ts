// A flight that is flown step by step: vehicle, controls or autopilot, and the history.

import type { Component } from '../fmu/component';
import { Instance, Refused } from '../fmu/instance';
import type { Values } from '../fmu/variables';
import { History } from './history';
import { at, end, type Manoeuvre } from './manoeuvre';
import { Pilot, type Wanted } from './pilot';

export interface Experiment {
  parameters: Values;
  /** Communication step, s. */
  step: number;
  autopilot: boolean;
}

export class Simulator {
  readonly history: History;
  /** Why the flight has ended, if it has. */
  ended: string | undefined;
  /** Controls by hand, as deviations from trim. */
  controls: Values = { delta_e: 0, phi: 0 };
  wanted: Wanted = { V_change: 0, gamma_wanted: 0 };
  /** Moves the controls until its end. */
  manoeuvre: Manoeuvre | undefined;

  private readonly recorded: Uint32Array;
  private readonly pilot: Pilot | undefined;
  private steps = 0;
  private applied: Values = {};

  private constructor(
    readonly vehicle: Instance,
    readonly experiment: Experiment,
    names: readonly string[],
    autopilot: Component | undefined,
  ) {
    this.recorded = vehicle.references(names);
    this.history = new History(['time', ...names]);
    const fuel = experiment.parameters['fuel_fraction'] ?? 1;
    if (experiment.autopilot && autopilot) this.pilot = new Pilot(autopilot, vehicle, fuel);
    this.add();
  }

  /** Trims the vehicle. What the FMU refuses is thrown. */
  static start(component: Component, autopilot: Component | undefined, experiment: Experiment): Simulator {
    const vehicle = Instance.start(component, experiment.parameters);
    const of = (causality: string): string[] =>
      component.fmu.variables.filter((variable) => variable.causality === causality).map(({ name }) => name);
    try {
      return new Simulator(vehicle, experiment, [...of('input'), ...of('output')], autopilot);
    } catch (error) {
      vehicle.free();
      throw error;
    }
  }

  get time(): number {
    return this.vehicle.time;
  }

  get flying(): boolean {
    return this.ended === undefined && !this.history.full;
  }

  /** One communication step, with a row of the history. What the FMU refuses ends the flight. */
  step(): void {
    const next = instant(this.steps + 1, this.experiment.step);
    try {
      this.apply();
      this.pilot?.stepTo(next, (name) => this.history.last(name), this.wanted);
      const { ended } = this.vehicle.stepTo(next);
      this.steps += 1;
      this.ended = ended;
      this.add();
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      this.ended = error.message;
    }
  }

  free(): void {
    this.pilot?.free();
    this.vehicle.free();
  }

  /** Inputs of the next step. They jump: the history then has a row before and one after. */
  private apply(): void {
    const inputs = this.inputs();
    const changed = Object.entries(inputs).filter(([name, value]) => value !== (this.applied[name] ?? 0));
    if (changed.length === 0) return;
    this.vehicle.set(Object.fromEntries(changed));
    this.applied = { ...this.applied, ...inputs };
    this.add();
  }

  private inputs(): Values {
    if (this.pilot) return this.pilot.commands();
    if (!this.manoeuvre) return this.controls;
    const values = at(this.manoeuvre, this.time);
    this.controls = { ...this.controls, ...Object.fromEntries(this.manoeuvre.inputs.map((name, i) => [name, values[i]!])) };
    if (this.time >= end(this.manoeuvre)) this.manoeuvre = undefined;
    return this.controls;
  }

  private add(): void {
    this.history.add(this.time, this.vehicle.read(this.recorded));
  }
}

/** The n-th communication point: the double nearest to n steps, as `cargo ahv fly` has it. */
export function instant(n: number, step: number): number {
  const rate = Math.round(1 / step);
  return 1 / rate === step ? n / rate : n * step;
}
