// All settings of the page, and the link that holds them.

import type { Values, Variable } from '../fmu/variables';

/** Parameters of the FMU that the page sets. */
export const PARAMETERS = [
  'configuration',
  'aero',
  'fuel_fraction',
  'slosh_damping',
  'slosh_frequency',
  'mach0',
  'altitude0',
] as const;

export const DEGREES = 180 / Math.PI;

/** Settings of the page itself: default, and what is allowed. Angles are in rad; `outputs` has a bit for each strip. */
export const OWN = {
  step: { start: 0.002, min: 0.0001, max: 0.1 },
  speed: { start: 0.5, min: 0.1, max: 10 },
  magnified: { start: 50, min: 1, max: 200 },
  window: { start: 5, min: 0.1, max: 1000 },
  autopilot: { start: 0, min: 0, max: 1, whole: true },
  manoeuvre: { start: 0, min: 0, max: 4, whole: true },
  delta_e: { start: 0, min: -2 / DEGREES, max: 2 / DEGREES },
  phi: { start: 0, min: -0.3, max: 0.3 },
  gamma_wanted: { start: 0, min: -1 / DEGREES, max: 1 / DEGREES },
  V_change: { start: 0, min: -30, max: 30 },
  map: { start: 0, min: 0, max: 2, whole: true },
  outputs: { start: 2 ** 8 - 1, min: 0, max: 2 ** 14 - 1, whole: true },
} as const;

export type Own = keyof typeof OWN;
type Parameter = (typeof PARAMETERS)[number];
export type Setting = Own | Parameter;

export class Settings {
  private readonly values: Record<Setting, number>;

  constructor(private readonly variables: ReadonlyMap<string, Variable>) {
    const parameters = PARAMETERS.map((name) => [name, this.start(name)]);
    const own = Object.keys(OWN).map((name) => [name, this.start(name as Own)]);
    this.values = Object.fromEntries([...parameters, ...own]) as Record<Setting, number>;
  }

  get(name: Setting): number {
    return this.values[name];
  }

  set(name: Setting, value: number): void {
    this.values[name] = value;
  }

  start(name: Setting): number {
    return isOwn(name) ? OWN[name].start : (this.variables.get(name)?.start ?? 0);
  }

  /** Parameters of the FMU that differ from its start values. */
  parameters(): Values {
    return Object.fromEntries(PARAMETERS.filter((name) => this.changed(name)).map((name) => [name, this.get(name)]));
  }

  /** What differs from the defaults, for a link. */
  link(): string {
    const changed = (Object.keys(this.values) as Setting[]).filter((name) => this.changed(name));
    return changed.map((name) => `${name}=${this.get(name)}`).join('&');
  }

  /** Takes the settings of a link, and the defaults of those that are not in it; returns what is no setting. */
  read(link: string): string[] {
    for (const name of Object.keys(this.values) as Setting[]) this.set(name, this.start(name));
    const refused: string[] = [];
    for (const [name, text] of new URLSearchParams(link)) {
      const value = Number(text);
      if (!this.allows(name, text === '' ? NaN : value)) refused.push(`${name}=${text}`);
      else this.set(name as Setting, value);
    }
    return refused;
  }

  /** Parameters beyond their range are left to the FMU, which says why it refuses them. */
  private allows(name: string, value: number): boolean {
    if (!Number.isFinite(value) || !Object.hasOwn(this.values, name)) return false;
    if (isOwn(name)) {
      const { min, max, whole } = { whole: false, ...OWN[name] };
      return value >= min && value <= max && (!whole || Number.isInteger(value));
    }
    return this.variables.get(name)?.type === 'real' || Number.isInteger(value);
  }

  private changed(name: Setting): boolean {
    return this.get(name) !== this.start(name);
  }
}

function isOwn(name: string): name is Own {
  return Object.hasOwn(OWN, name);
}
