// Inputs of the page: they show the settings, and say what the user changes.

import type { Variable } from '../fmu/variables';
import { input, select, shown } from './element';
import type { Setting, Settings } from './settings';

/** Parameters with an element of their name; the vehicle is trimmed again when one changes. */
const VEHICLE = ['configuration', 'aero', 'fuel_fraction', 'slosh_damping', 'slosh_frequency', 'mach0', 'altitude0'] as const;
const SELECTED = ['configuration', 'aero', 'step', 'window', 'map'] as const;

const TEXTS: Record<string, (value: number) => string> = {
  fuel_fraction: (value) => `${shown(100 * value)} %`,
  slosh_damping: (value) => shown(value),
  slosh_frequency: (value) => (value === 0 ? 'from tanks' : `${shown(value)} rad/s`),
  magnified: (value) => shown(value),
  speed: (value) => `${shown(value, 2)} ×`,
};

/** The liquid moves further than the fuselage bends: its factor is this part of that of the deformation. */
export const LIQUID = 0.1;

export interface Changes {
  /** A parameter of the vehicle, or the step. */
  vehicle(): void;
  /** What the flight itself does not depend on. */
  view(): void;
  /** The window of the pole-zero map. */
  map(): void;
}

/** Fills the lists from the FMU, and connects all inputs with the settings. */
export function connect(settings: Settings, variables: ReadonlyMap<string, Variable>, changes: Changes): void {
  for (const name of ['configuration', 'aero'] as const) {
    const items = variables.get(name)!.items!;
    select(name).replaceChildren(...items.map(({ name: text, value }) => new Option(text, String(value))));
  }
  const changed = (name: Setting, value: number, happened: () => void): void => {
    if (!Number.isFinite(value)) return;
    settings.set(name, value);
    show(settings);
    happened();
  };
  for (const name of VEHICLE) {
    const source = document.getElementById(name)!;
    const event = source instanceof HTMLInputElement && source.type === 'range' ? 'input' : 'change';
    source.addEventListener(event, () => changed(name, Number((source as HTMLInputElement).value || NaN), changes.vehicle));
  }
  for (const [name, happened] of [['step', changes.vehicle], ['window', changes.view], ['map', changes.map]] as const) {
    select(name).addEventListener('change', () => changed(name, Number(select(name).value), happened));
  }
  input('magnified').addEventListener('input', () => changed('magnified', input('magnified').valueAsNumber, changes.view));
  input('speed').addEventListener('input', () => changed('speed', 10 ** input('speed').valueAsNumber, changes.view));
  show(settings);
}

/** Shows the settings. */
export function show(settings: Settings): void {
  for (const name of SELECTED) selected(select(name), settings.get(name));
  for (const name of [...VEHICLE, 'magnified'] as const) {
    const target = document.getElementById(name);
    if (target instanceof HTMLInputElement) target.value = String(settings.get(name));
  }
  input('speed').value = String(Math.log10(settings.get('speed')));
  for (const [name, text] of Object.entries(TEXTS)) {
    document.getElementById(`${name}-value`)!.textContent = text(settings.get(name as Setting));
  }
  const magnified = settings.get('magnified');
  document.getElementById('magnified-seen')!.textContent = shown(magnified);
  document.getElementById('liquid-seen')!.textContent = shown(magnified * LIQUID);
}

/** Selects a number, which may come from a link and not be in the list. */
function selected(list: HTMLSelectElement, value: number): void {
  if (![...list.options].some((option) => Number(option.value) === value)) list.add(new Option(shown(value), String(value)));
  list.value = [...list.options].find((option) => Number(option.value) === value)!.value;
}
