// The page: settings, and the flight that follows from them.

import type { VehicleData, Published } from '../data';
import { parse, type Manoeuvre } from '../flight/manoeuvre';
import { sample, type Shapes } from '../flight/shapes';
import { Simulator } from '../flight/simulator';
import type { Component } from '../fmu/component';
import type { Values } from '../fmu/variables';
import { roots } from '../linear/roots';
import { Clock } from './clock';
import { command, FILE } from './command';
import { connect, show } from './controls';
import { Display } from './display';
import { button, download, element, input, shown } from './element';
import { onKeys } from './keyboard';
import { PoleMap } from './map';
import { Settings } from './settings';
import { COMMANDS, Stick } from './stick';

/** Stations at which the shapes are known; the highest mode has three nodes. */
const STATIONS = 21;
/** Initial states of the release tests, m: the manoeuvres after those of input files. */
const RELEASED: Values[] = [{ slosh1_offset: 0.05, slosh2_offset: 0.05 }, { eta1_offset: 0.05 }];

export interface Parts {
  vehicle: Component;
  autopilot: Component | undefined;
  data: VehicleData;
  published: Published;
  /** Input files of the manoeuvres, in the order of their numbers. */
  manoeuvres: string[];
}

export class App {
  private readonly settings: Settings;
  private readonly manoeuvres: Manoeuvre[];
  private readonly clock = new Clock();
  private readonly stick = new Stick(() => this.steer());
  private readonly display: Display;
  private readonly map: PoleMap;
  private simulator: Simulator;
  private sampling: Generator<undefined, Shapes> | undefined;
  private sampled = '';

  constructor(private readonly parts: Parts) {
    const { variables } = parts.vehicle;
    this.settings = new Settings(variables);
    this.manoeuvres = parts.manoeuvres.map(parse);
    this.display = new Display(parts.data, variables, this.settings);
    this.map = new PoleMap(parts.published);
    this.simulator = this.start();
    this.adopt();
  }

  /** Connects the controls, takes the settings of the link, and begins to draw. */
  run(): void {
    connect(this.settings, this.parts.vehicle.variables, { vehicle: () => this.restart(), view: () => this.display.look(), map: () => this.map.look(this.settings.get('map')) });
    button('play').addEventListener('click', () => this.play(!this.clock.playing));
    button('single').addEventListener('click', () => this.single());
    button('restart').addEventListener('click', () => this.restart());
    button('export').addEventListener('click', () => download(FILE, this.simulator.history.csv()));
    button('share').addEventListener('click', () => void this.share());
    for (const one of document.querySelectorAll<HTMLButtonElement>('[data-manoeuvre]')) {
      one.addEventListener('click', () => this.fly(Number(one.dataset['manoeuvre'])));
    }
    for (const id of ['autopilot-row', 'autopilot-hint']) element(id, HTMLElement).hidden = !this.parts.autopilot;
    input('autopilot').addEventListener('change', () => this.engage(input('autopilot').checked));
    const keys = { ' ': () => this.play(!this.clock.playing), '.': () => this.single(), r: () => this.restart(), '0': () => this.centre(), '1': () => this.fly(1), '2': () => this.fly(2), '3': () => this.fly(3), '4': () => this.fly(4), a: () => this.engage(!this.stick.autopilot) };
    onKeys(keys, (key) => this.stick.key(key));
    window.addEventListener('hashchange', () => this.open());
    this.open();
    requestAnimationFrame((now) => this.frame(now));
  }

  /** Settings of the link in the address. */
  private open(): void {
    const refused = this.settings.read(location.hash.slice(1));
    show(this.settings);
    this.map.look(this.settings.get('map'));
    this.display.choose();
    this.use(this.settings.get('autopilot') === 1 && this.parts.autopilot !== undefined);
    for (const name of COMMANDS) this.stick.show(name, this.settings.get(name));
    this.restart();
    if (refused.length > 0) this.say(`The link has settings that this page does not know: ${refused.join(', ')}`);
  }

  private start(): Simulator {
    return Simulator.start(this.parts.vehicle, this.parts.autopilot, {
      parameters: { ...this.settings.parameters(), ...RELEASED[this.settings.get('manoeuvre') - 1 - this.manoeuvres.length] },
      step: this.settings.get('step'),
      autopilot: this.stick.autopilot,
    });
  }

  /** A new flight from trim. If there is none, the last one stays, and the FMU says why. */
  private restart(): boolean {
    try {
      const next = this.start();
      this.simulator.free();
      this.simulator = next;
    } catch (error) {
      this.say(error instanceof Error ? error.message : String(error));
      return false;
    }
    this.say('');
    this.adopt();
    this.command();
    this.simulator.manoeuvre = this.manoeuvres[this.settings.get('manoeuvre') - 1];
    if (this.clock.playing) this.clock.start(this.simulator);
    return true;
  }

  /** What follows from the parameters of a new flight. */
  private adopt(): void {
    const { vehicle } = this.simulator;
    this.display.massCentre = vehicle.get('mass_centre');
    const { derivatives } = this.parts.vehicle.fmu;
    const configuration = this.settings.get('configuration');
    this.map.show(roots(vehicle, derivatives, configuration), configuration);
    const parameters = this.settings.parameters();
    const key = JSON.stringify(parameters);
    if (key !== this.sampled) this.sampling = sample(this.parts.vehicle, parameters, this.parts.data.geometry.length_m, STATIONS);
    this.sampled = key;
    const fuel = this.settings.get('fuel_fraction');
    if (fuel > 0) this.display.fullTanks = vehicle.get('fuel_mass') / fuel;
    this.display.look();
  }

  private play(playing: boolean): void {
    if (playing && !this.simulator.flying && !this.restart()) return;
    this.clock.playing = playing;
    if (playing) this.clock.start(this.simulator);
    button('play').textContent = playing ? 'Pause' : 'Play';
    this.display.look();
  }

  private single(): void {
    this.play(false);
    if (this.simulator.flying) this.simulator.step();
    this.check();
    this.display.look();
  }

  /** A manoeuvre of an input file is flown by hand, a release also by the autopilot. */
  private fly(manoeuvre: number): void {
    if (manoeuvre <= this.manoeuvres.length) this.engage(false);
    this.centre();
    this.settings.set('manoeuvre', manoeuvre);
    if (this.restart()) this.play(true);
  }

  private engage(autopilot: boolean): void {
    if (!this.parts.autopilot || autopilot === this.stick.autopilot) return;
    this.use(autopilot);
    this.settings.set('autopilot', Number(autopilot));
    this.centre();
    this.restart();
  }

  private use(autopilot: boolean): void {
    this.stick.use(autopilot);
    input('autopilot').checked = autopilot;
  }

  private centre(): void {
    this.stick.centre();
    this.steer();
  }

  /** By hand: a manoeuvre that is being flown is given up. */
  private steer(): void {
    for (const name of COMMANDS) this.settings.set(name, this.stick.value(name));
    this.settings.set('manoeuvre', 0);
    this.simulator.manoeuvre = undefined;
    this.command();
  }

  private command(): void {
    const held = (name: (typeof COMMANDS)[number]): number => this.settings.get(name);
    this.simulator.controls = { delta_e: held('delta_e'), phi: held('phi') };
    this.simulator.wanted = { V_change: held('V_change'), gamma_wanted: held('gamma_wanted') };
  }

  private frame(now: number): void {
    const flown = this.clock.fly(this.simulator, now, this.settings.get('speed'));
    if (flown) this.check();
    const asked = this.sampling?.next();
    if (asked?.done) {
      this.display.shapes = asked.value;
      this.sampling = undefined;
      this.display.look();
    }
    if (this.display.frame(this.simulator, now, flown)) this.tell();
    requestAnimationFrame((next) => this.frame(next));
  }

  /** Pauses where the flight has ended. */
  private check(): void {
    if (this.simulator.flying) return;
    this.play(false);
    this.say(this.simulator.ended ?? 'The history is full: save it, or restart.');
  }

  /** What the page says of the flight beside its numbers. */
  private tell(): void {
    for (const name of ['delta_e', 'phi'] as const) {
      if (!this.stick.autopilot) this.stick.show(name, this.simulator.controls[name]!);
    }
    element('rate', HTMLElement).textContent = this.clock.playing ? `${shown(this.clock.rate(), 2)} frames/s` : '';
    if (!this.clock.playing) element('command', HTMLElement).textContent = command(this.simulator, this.parts.vehicle.variables);
  }

  private say(text: string): void {
    element('message', HTMLElement).textContent = text;
  }

  /** A link with all settings, in the address and on the clipboard. */
  private async share(): Promise<void> {
    const link = this.settings.link();
    history.replaceState(null, '', link ? `#${link}` : location.pathname);
    try {
      await navigator.clipboard.writeText(location.href);
      this.say('The link with all settings is on the clipboard.');
    } catch {
      this.say('The address of this page now holds all settings.');
    }
  }
}
