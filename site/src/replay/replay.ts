// A flight that has been flown: the vehicle and its time history, at the time of a slider.

import { outline, type Outline } from '../drawing/outline';
import { pose } from '../drawing/pose';
import { draw } from '../drawing/scene';
import { onThemeChange, theme, type Theme } from '../drawing/theme';
import { History } from '../flight/history';
import type { Variable } from '../fmu/variables';
import { LIQUID } from '../page/controls';
import { button, element, input, select, shown } from '../page/element';
import { onKeys } from '../page/keyboard';
import { Readout } from '../page/readout';
import { Strips } from '../page/strips';
import type { FlightData } from './flight';

export class Replay {
  private readonly history: History;
  private readonly times: Float64Array;
  private readonly outline: Outline;
  private readonly readout: Readout;
  private readonly strips: Strips;
  private readonly canvas = element('scene', HTMLCanvasElement);
  private theme: Theme = theme();
  private playing = false;
  private last = 0;

  constructor(private readonly flight: FlightData) {
    this.history = History.of(flight.names, flight.columns);
    this.times = this.history.column('time');
    this.outline = outline(flight.vehicle);
    const variables = new Map(flight.variables.map((variable) => [variable.name, variable as Variable]));
    this.readout = new Readout(variables);
    this.strips = new Strips(variables, this.theme, () => this.draw());
  }

  run(): void {
    const { title, summary, ended, set } = this.flight;
    element('title', HTMLElement).textContent = title;
    element('summary', HTMLElement).textContent = summary;
    element('message', HTMLElement).textContent = ended;
    const rows = set.map((cells) => {
      const row = document.createElement('tr');
      for (const text of cells) row.insertCell().textContent = text;
      return row;
    });
    element('set', HTMLTableSectionElement).replaceChildren(...rows);
    const [first, last] = [this.times[0]!, this.times.at(-1)!];
    Object.assign(input('time'), { min: String(first), max: String(last), value: String(first) });
    input('time').addEventListener('input', () => this.show());
    input('magnified').addEventListener('input', () => this.show());
    button('play').addEventListener('click', () => this.play(!this.playing));
    onKeys({ ' ': () => this.play(!this.playing), '.': () => this.move(1), ',': () => this.move(-1) }, (key) => this.arrow(key));
    onThemeChange(() => {
      this.theme = theme();
      this.strips.recolour(this.theme);
      this.draw();
    });
    new ResizeObserver(() => this.show()).observe(this.canvas);
    this.draw();
  }

  private draw(): void {
    this.strips.showAll(this.history, Infinity);
    this.show();
  }

  private arrow(key: string): boolean {
    const instants = { ArrowLeft: -1, ArrowRight: 1 }[key];
    if (instants !== undefined) this.move(instants);
    return instants !== undefined;
  }

  /** To the next instant, or to the one before; a jump has two rows at one instant. */
  private move(direction: number): void {
    const now = this.times[this.row()]!;
    const other = direction > 0 ? this.times.find((time) => time > now) : this.times.findLast((time) => time < now);
    input('time').value = String(other ?? now);
    this.show();
  }

  private play(playing: boolean): void {
    const time = input('time');
    if (playing && Number(time.value) >= Number(time.max)) time.value = time.min;
    this.playing = playing;
    button('play').textContent = playing ? 'Pause' : 'Play';
    if (!playing) return;
    this.last = performance.now();
    requestAnimationFrame((now) => this.frame(now));
  }

  private frame(now: number): void {
    if (!this.playing) return;
    const time = input('time');
    const next = Number(time.value) + ((now - this.last) / 1000) * Number(select('speed').value);
    this.last = now;
    time.value = String(Math.min(next, Number(time.max)));
    this.show();
    if (next >= Number(time.max)) this.play(false);
    else requestAnimationFrame((later) => this.frame(later));
  }

  /** The last row at or before the time of the slider. */
  private row(): number {
    const time = Number(input('time').value);
    const next = this.times.findIndex((row) => row > time);
    return next < 0 ? this.times.length - 1 : Math.max(0, next - 1);
  }

  private show(): void {
    const [row, magnified] = [this.row(), input('magnified').valueAsNumber];
    const { vehicle, shapes, mass_centre_m, full_tanks_kg_per_m } = this.flight;
    const now = pose((name) => this.history.value(name, row), this.history.value('fuel_mass', row) / full_tanks_kg_per_m);
    const look = { shapes: shapes ?? undefined, magnified, liquid: magnified * LIQUID, massCentre: mass_centre_m };
    const { lower_angle_rad: lower, upper_angle_rad: upper } = vehicle.outline;
    draw(this.canvas, this.outline, { lower, upper }, now, look, this.theme);
    element('magnified-seen', HTMLElement).textContent = shown(magnified);
    element('liquid-seen', HTMLElement).textContent = shown(magnified * LIQUID);
    this.readout.show(this.history, row);
    this.strips.point(this.times[row]!);
  }
}
