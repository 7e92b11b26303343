// Poles and transmission zeros of the trimmed vehicle, from the FMU's directional derivatives.

import { EigenvalueDecomposition, Matrix as Dense } from 'ml-matrix';
import type { Instance } from '../fmu/instance';
import { balance, pick, solve2, times, type Matrix } from './matrix';

/** A real root, or a complex pair by its upper half; rad/s. */
export interface Root {
  re: number;
  im: number;
}

export interface Roots {
  poles: Root[];
  /** From delta_e and phi to V and gamma. */
  zeros: Root[];
}

const INPUTS = ['delta_e', 'phi'];
const OUTPUTS = ['V', 'gamma'];
/** States in use, by number of the configuration; the fuel is none while it does not burn. */
const STATES_IN_USE: Record<number, number> = { 1: 5, 2: 11, 3: 15 };

/** Of a vehicle in trimmed flight; `derivatives` are the names of the FMU's state derivatives. */
export function roots(trimmed: Instance, derivatives: readonly string[], configuration: number): Roots {
  const rates = derivatives.slice(0, STATES_IN_USE[configuration]);
  const states = rates.map((name) => name.slice('der('.length, -1));
  const a = trimmed.jacobian(rates, states);
  const b = trimmed.jacobian(rates, INPUTS);
  const held = OUTPUTS.map((name) => states.indexOf(name));
  return { poles: eigenvalues(a), zeros: eigenvalues(zeroDynamics(a, b, held)) };
}

/**
 * Matrix of the zero dynamics if the outputs are the states `held`: with these at rest u = -B_y^-1 A_yz z, and
 * z' = (A_zz - B_z B_y^-1 A_yz) z, where z are the other states. Empty if B_y is singular.
 */
export function zeroDynamics(a: Matrix, b: Matrix, held: readonly number[]): Matrix {
  const free = a.map((_, row) => row).filter((row) => !held.includes(row));
  const inputs = [0, 1];
  const control = solve2(pick(b, held, inputs) as [[number, number], [number, number]], pick(a, held, free));
  if (!control) return [];
  const moved = times(pick(b, free, inputs), control);
  return pick(a, free, free).map((row, i) => row.map((value, j) => value - moved[i]![j]!));
}

/** Eigenvalues by frequency, of each pair the upper one. */
export function eigenvalues(matrix: Matrix): Root[] {
  if (matrix.length === 0) return [];
  const { realEigenvalues, imaginaryEigenvalues } = new EigenvalueDecomposition(new Dense(balance(matrix)), {
    assumeSymmetric: false,
  });
  return realEigenvalues
    .map((re, i) => ({ re, im: imaginaryEigenvalues[i]! }))
    .filter(({ im }) => im >= 0)
    .sort((one, other) => Math.hypot(one.re, one.im) - Math.hypot(other.re, other.im));
}
