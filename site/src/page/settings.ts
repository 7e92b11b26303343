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
  'eta1_offset',
  'slosh1_offset',
  'slosh2_offset',
] as const;

/** Settings of the page itself: default, and what is allowed. */
const OWN = {
  step: { start: 0.002, min: 0.0001, max: 0.1 },
  speed: { start: 0.5, min: 0.1, max: 10 },
  magnified: { start: 50, min: 1, max: 200 },
  window: { start: 5, min: 0.1, max: 1000 },
  autopilot: { start: 0, min: 0, max: 1 },
  manoeuvre: { start: 0, min: 0, max: 2 },
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

  /** Takes the settings of a link; returns what is no setting. */
  read(link: string): string[] {
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
    if (isOwn(name)) return value >= OWN[name].min && value <= OWN[name].max;
    return this.variables.get(name)?.type === 'real' || Number.isInteger(value);
  }

  private changed(name: Setting): boolean {
    return this.get(name) !== this.start(name);
  }
}

function isOwn(name: string): name is Own {
  return Object.hasOwn(OWN, name);
}
