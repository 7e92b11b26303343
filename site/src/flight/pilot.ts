// The autopilot's FMU beside the vehicle's: it reads the vehicle where a step begins, its commands act where it ends.

import type { Component } from '../fmu/component';
import { Instance } from '../fmu/instance';

const COMMANDS = ['delta_e', 'phi'] as const;

/** What the autopilot is asked for. */
export interface Wanted {
  /** Change of speed since the start, m/s. */
  V_change: number;
  /** Flight-path angle, rad. */
  gamma_wanted: number;
}

/** How fast what the autopilot follows changes, per second, as in the climb of the examples: a jump would saturate the elevator. */
const RATES: Wanted = { V_change: 0.5, gamma_wanted: 0.0175 / 20 };

export class Pilot {
  private followed: Wanted = { V_change: 0, gamma_wanted: 0 };
  private readonly fmu: Instance;
  private readonly commanded: Uint32Array;

  /** For a vehicle that has just been initialised, with its level flight. */
  constructor(
    component: Component,
    vehicle: Instance,
    fuelFraction: number,
  ) {
    this.fmu = Instance.start(component, {
      fuel_fraction: fuelFraction,
      V_level: vehicle.get('V'),
      delta_e_trim: vehicle.get('delta_e_trim'),
      phi_trim: vehicle.get('phi_trim'),
    });
    this.commanded = this.fmu.references(COMMANDS);
  }

  /** From outputs of the vehicle, steps to a time; moves towards what is wanted. */
  stepTo(time: number, output: (name: string) => number, wanted: Wanted): void {
    const most = time - this.fmu.time;
    for (const name of ['V_change', 'gamma_wanted'] as const) {
      const change = wanted[name] - this.followed[name];
      this.followed[name] += Math.max(-RATES[name] * most, Math.min(RATES[name] * most, change));
    }
    this.fmu.set({ V: output('V'), gamma: output('gamma'), q: output('q'), fuel_mass: output('fuel_mass'), ...this.followed });
    this.fmu.stepTo(time);
  }

  /** Commands in force, as deviations from trim. */
  commands(): { delta_e: number; phi: number } {
    const [delta_e, phi] = this.fmu.read(this.commanded) as unknown as [number, number];
    return { delta_e, phi };
  }

  free(): void {
    this.fmu.free();
  }
}
