// Mode shapes of the vehicle that flies: the FMU tells them at the station of its IMU, so one instance is asked per
// station. Between stations they are cubic, with the FMU's slopes.

import type { Component } from '../fmu/component';
import { Instance } from '../fmu/instance';
import type { Values } from '../fmu/variables';

const MODES = 3;
const ASKED = ['shape1_imu', 'shape2_imu', 'shape3_imu', 'slope1_imu', 'slope2_imu', 'slope3_imu'];

export interface Shapes {
  /** m aft of the nose, increasing by equal steps. */
  stations: number[];
  /** Displacement up per nose deflection, by mode and station. */
  displacement: number[][];
  /** d(displacement)/dx, 1/m. */
  slope: number[][];
}

/** Asks for one station per iteration, so that the caller can draw in between. */
export function* sample(component: Component, parameters: Values, length_m: number, count: number): Generator<undefined, Shapes> {
  const stations = Array.from({ length: count }, (_, i) => (i / (count - 1)) * length_m);
  const columns: Float64Array[] = [];
  for (const imu_station of stations) {
    const instance = Instance.start(component, { ...parameters, imu_station });
    columns.push(instance.read(instance.references(ASKED)));
    instance.free();
    yield;
  }
  const rows = ASKED.map((_, row) => columns.map((column) => column[row]!));
  return { stations, displacement: rows.slice(0, MODES), slope: rows.slice(MODES) };
}

/** Deflection up at a station, m, for nose deflections `eta` of the modes. */
export function deflection({ stations, displacement, slope }: Shapes, eta: readonly number[], x: number): number {
  const width = stations[1]! - stations[0]!;
  const element = Math.min(Math.max(Math.floor(x / width), 0), stations.length - 2);
  const s = x / width - element;
  const weights = [(1 + 2 * s) * (1 - s) ** 2, s * (1 - s) ** 2 * width, s * s * (3 - 2 * s), s * s * (s - 1) * width];
  return eta.reduce((sum, amplitude, mode) => {
    const [w, dw] = [displacement[mode]!, slope[mode]!];
    const nodes = [w[element]!, dw[element]!, w[element + 1]!, dw[element + 1]!];
    return sum + amplitude * nodes.reduce((total, node, i) => total + node * weights[i]!, 0);
  }, 0);
}
