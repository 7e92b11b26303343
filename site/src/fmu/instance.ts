// One instance of an FMU for Co-Simulation, with its variables by name.

import type { Component } from './component';
import type { Values, Variable } from './variables';
import type { CoSimulation, Status } from './wit';

/** The FMU has refused a call: `message` is its own text. */
export class Refused extends Error {
  override readonly name = 'Refused';
}

/** Outcome of a step. */
export interface Step {
  /** Time that was reached, s. */
  time: number;
  /** Why the FMU ends the flight, if it does. */
  ended?: string;
}

export class Instance {
  private constructor(
    private readonly component: Component,
    private readonly fmu: CoSimulation,
    private now: number,
  ) {}

  /** An initialised instance. */
  static start(component: Component, parameters: Values, inputs: Values = {}, tolerance?: number): Instance {
    const instance = attempt(component, () => {
      const { CoSimulationInstance: type } = component.exports.coSimulation;
      const { name, token } = component.fmu;
      return type.instantiateCoSimulation(name, token, '', false, false, false, false, new Uint32Array());
    });
    if (!instance) throw new Refused(lastMessage(component));
    const started = new Instance(component, instance, 0);
    try {
      started.set(parameters);
      started.set(inputs);
      started.done(() => instance.enterInitializationMode(tolerance, 0, undefined));
      started.done(() => instance.exitInitializationMode());
    } catch (error) {
      started.free();
      throw error;
    }
    return started;
  }

  /** Time of the last communication point, s. */
  get time(): number {
    return this.now;
  }

  /** Sets variables, in SI: all reals in one call, because a call costs more than what it does. */
  set(values: Values): void {
    const [references, reals] = [new Array<number>(), new Array<number>()];
    for (const [name, value] of Object.entries(values)) {
      const { reference, type } = this.variable(name);
      const one = Uint32Array.of(reference);
      if (type === 'real') {
        references.push(reference);
        reals.push(value);
      } else if (type === 'boolean') this.done(() => this.fmu.setBoolean(one, [value !== 0]));
      else this.done(() => this.fmu.setInt64(one, BigInt64Array.of(BigInt(value))));
    }
    if (reals.length > 0) this.done(() => this.fmu.setFloat64(Uint32Array.from(references), Float64Array.from(reals)));
  }

  /** References for `read`, which is called often. */
  references(names: readonly string[]): Uint32Array {
    return Uint32Array.from(names, (name) => this.variable(name).reference);
  }

  /** Real variables, in SI. */
  read(references: Uint32Array): Float64Array {
    return attempt(this.component, () => this.fmu.getFloat64(references));
  }

  get(name: string): number {
    return this.read(this.references([name]))[0] ?? NaN;
  }

  /** Steps to a time. If the FMU ends the flight, its values are those of the last valid instant. */
  stepTo(time: number): Step {
    const size = time - this.now;
    const result = attempt(this.component, () => this.fmu.doStep(this.now, size, true));
    const ended = result.terminateSimulation;
    this.now = ended ? result.lastSuccessfulTime : time;
    return ended ? { time: this.now, ended: lastMessage(this.component) } : { time };
  }

  /** Derivatives of unknowns (rows) by knowns (columns), exact. */
  jacobian(unknowns: readonly string[], knowns: readonly string[]): number[][] {
    const rows = this.references(unknowns);
    const columns = knowns.map((known) =>
      attempt(this.component, () =>
        this.fmu.getDirectionalDerivative(rows, this.references([known]), Float64Array.of(1)),
      ),
    );
    return unknowns.map((_, row) => columns.map((column) => column[row] ?? NaN));
  }

  state(): { bytes: Uint8Array; time: number } {
    return { bytes: attempt(this.component, () => this.fmu.getFmuState()), time: this.now };
  }

  restore(state: { bytes: Uint8Array; time: number }): void {
    this.done(() => this.fmu.setFmuState(state.bytes));
    this.now = state.time;
  }

  free(): void {
    try {
      this.fmu[Symbol.dispose]();
    } catch {
      // After a trap it is lost anyway.
    }
  }

  private variable(name: string): Variable {
    const variable = this.component.variables.get(name);
    if (!variable) throw new Error(`${this.component.fmu.name} has no variable ${name}`);
    return variable;
  }

  private done(call: () => Status): void {
    const status = attempt(this.component, call);
    if (status !== 'ok' && status !== 'warning') throw new Refused(lastMessage(this.component));
  }
}

/** A call; what it throws is a refusal, or a trap of the component. */
function attempt<T>(component: Component, call: () => T): T {
  component.log.length = 0;
  try {
    return call();
  } catch (error) {
    if (error instanceof WebAssembly.RuntimeError) component.renew();
    else if (!(error instanceof Error && 'payload' in error)) throw error;
    throw new Refused(lastMessage(component, String(error)));
  }
}

function lastMessage(component: Component, otherwise = 'the FMU gives no reason'): string {
  return component.log.at(-1)?.text ?? otherwise;
}
