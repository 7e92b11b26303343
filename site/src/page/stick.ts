// What the pilot of the page holds: controls by hand, or what the autopilot is asked for.

import { element, input, shown } from './element';
import { DEGREES } from './settings';

const HAND = ['delta_e', 'phi'] as const;
const ASKED = ['gamma_wanted', 'V_change'] as const;
export const COMMANDS = [...HAND, ...ASKED] as const;
type Name = (typeof COMMANDS)[number];

/** Steps of a slider per key. */
const STEPS_PER_KEY = 5;
const UNITS: Record<Name, { unit: string; factor: number }> = {
  delta_e: { unit: '°', factor: DEGREES },
  phi: { unit: '', factor: 1 },
  gamma_wanted: { unit: '°', factor: DEGREES },
  V_change: { unit: ' m/s', factor: 1 },
};

export class Stick {
  autopilot = false;

  constructor(private readonly moved: () => void) {
    for (const name of COMMANDS) {
      input(name).addEventListener('input', () => {
        this.label(name);
        moved();
      });
    }
    this.centre();
  }

  /** Value of a slider, SI. */
  value(name: Name): number {
    return input(name).valueAsNumber / UNITS[name].factor;
  }

  /** Moves a slider, as a manoeuvre or a link does. */
  show(name: Name, value: number): void {
    const text = String(value * UNITS[name].factor);
    if (Number(input(name).value) === Number(text)) return;
    input(name).value = text;
    this.label(name);
  }

  use(autopilot: boolean): void {
    this.autopilot = autopilot;
    element('hand', HTMLFieldSetElement).hidden = autopilot;
    element('wanted', HTMLFieldSetElement).hidden = !autopilot;
  }

  /** All sliders in the middle. */
  centre(): void {
    for (const name of COMMANDS) {
      input(name).value = '0';
      this.label(name);
    }
  }

  /** An arrow key; whether it is one. */
  key(key: string): boolean {
    const [pitch, power] = this.autopilot ? ASKED : HAND;
    // Up is nose up, which is the trailing edge of the elevator up.
    const up = this.autopilot ? 1 : -1;
    const moves: Record<string, [Name, number]> = {
      ArrowUp: [pitch, up],
      ArrowDown: [pitch, -up],
      ArrowRight: [power, 1],
      ArrowLeft: [power, -1],
    };
    const move = moves[key];
    if (!move) return false;
    const [name, sign] = move;
    if (sign > 0) input(name).stepUp(STEPS_PER_KEY);
    else input(name).stepDown(STEPS_PER_KEY);
    this.label(name);
    this.moved();
    return true;
  }

  private label(name: Name): void {
    const value = input(name).valueAsNumber;
    document.getElementById(`${name}-value`)!.textContent = `${shown(value, 3)}${UNITS[name].unit}`;
  }
}

