// Current values in numbers, in the units that the FMU displays.

import type { History } from '../flight/history';
import type { Variable } from '../fmu/variables';
import { element, shown } from './element';

const LABELS: Record<string, string> = {
  time: 'Time',
  mach: 'Mach number',
  h: 'Altitude',
  alpha: 'Angle of attack',
  gamma: 'Flight path',
  q: 'Pitch rate',
  n_z: 'Load factor',
  eta1: 'First mode',
  slosh1: 'Liquid, fore',
  slosh2: 'Liquid, aft',
  delta_e_effective: 'Elevator',
  phi_effective: 'Fuel ratio',
};
const DIGITS: Record<string, number> = { h: 6, time: 5 };

export class Readout {
  private readonly cells: { name: string; factor: number; value: HTMLElement }[];

  constructor(variables: ReadonlyMap<string, Variable>) {
    const list = element('readout', HTMLDListElement);
    const known = Object.entries(LABELS).filter(([name]) => variables.has(name));
    this.cells = known.map(([name, label]) => {
      const variable = variables.get(name)!;
      const [row, term, value] = [document.createElement('div'), document.createElement('dt'), document.createElement('dd')];
      const { unit, factor } = variable.display;
      term.textContent = unit === '1' ? label : `${label}, ${unit}`;
      term.title = variable.description ? `${name}: ${variable.description}` : name;
      row.append(term, value);
      list.append(row);
      return { name, factor, value };
    });
  }

  show(history: History, row = history.length - 1): void {
    for (const { name, factor, value } of this.cells) {
      const text = shown(history.value(name, row) * factor, DIGITS[name] ?? 4);
      if (value.textContent !== text) value.textContent = text;
    }
  }
}
