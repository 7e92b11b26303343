// The part of the components' interface that the page calls, as jco presents it.

export type Status = 'ok' | 'warning' | 'discard' | 'error' | 'fatal';

export interface StepResult {
  lastSuccessfulTime: number;
  terminateSimulation: boolean;
}

/** An instance for Co-Simulation. Functions without a status throw `{ payload: Status }`. */
export interface CoSimulation extends Disposable {
  enterInitializationMode(tolerance: number | undefined, start: number, stop: number | undefined): Status;
  exitInitializationMode(): Status;
  getFloat64(references: Uint32Array): Float64Array;
  getInt64(references: Uint32Array): BigInt64Array;
  getBoolean(references: Uint32Array): boolean[];
  setFloat64(references: Uint32Array, values: Float64Array): Status;
  setInt64(references: Uint32Array, values: BigInt64Array): Status;
  setBoolean(references: Uint32Array, values: boolean[]): Status;
  getFmuState(): Uint8Array;
  setFmuState(state: Uint8Array): Status;
  getDirectionalDerivative(unknowns: Uint32Array, knowns: Uint32Array, seed: Float64Array): Float64Array;
  doStep(time: number, size: number, noEarlierState: boolean): StepResult;
}

export interface Exports {
  coSimulation: {
    CoSimulationInstance: {
      instantiateCoSimulation(
        name: string,
        token: string,
        resources: string,
        visible: boolean,
        logging: boolean,
        eventMode: boolean,
        earlyReturn: boolean,
        intermediate: Uint32Array,
      ): CoSimulation | undefined;
    };
  };
}

export type Instantiate = (
  core: (path: string) => WebAssembly.Module,
  imports: Record<string, Record<string, unknown>>,
) => Exports;
