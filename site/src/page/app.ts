// The page: settings, the flight, and what shows it.

import type { VehicleData, Published } from '../data';
import { outline, type Outline } from '../drawing/outline';
import { pose, type Pose } from '../drawing/pose';
import { draw, type Look } from '../drawing/scene';
import { onThemeChange, theme, type Theme } from '../drawing/theme';
import { parse, type Manoeuvre } from '../flight/manoeuvre';
import { sample, type Shapes } from '../flight/shapes';
import { Simulator } from '../flight/simulator';
import type { Component } from '../fmu/component';
import { roots } from '../linear/roots';
import { Clock } from './clock';
import { command, FILE } from './command';
import { connect, LIQUID, show } from './controls';
import { button, download, element, input, shown } from './element';
import { onKeys } from './keyboard';
import { PoleMap } from './map';
import { Readout } from './readout';
import { Settings } from './settings';
import { Stick } from './stick';
import { Strips } from './strips';

/** Stations at which the shapes are known; the highest mode has three nodes. */
const STATIONS = 21;
/** Time between frames for those who want little motion, ms. */
const CALM_MS = 500;
/** Initial states for the release tests, m. */
const RELEASED = {
  slosh: { slosh1_offset: 0.05, slosh2_offset: 0.05 },
  bend: { eta1_offset: 0.05 },
};

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
  private readonly outline: Outline;
  private readonly manoeuvres: Manoeuvre[];
  private readonly clock = new Clock();
  private readonly stick = new Stick(() => this.steer());
  private readonly readout: Readout;
  private readonly strips: Strips;
  private readonly map: PoleMap;
  private readonly canvas = element('scene', HTMLCanvasElement);
  private simulator: Simulator;
  private shapes: Shapes | undefined;
  private sampling: Generator<undefined, Shapes> | undefined;
  private sampled = '';
  private massCentre = 0;
  private fullTanks = 1;
  private theme: Theme = theme();
  private stale = true;
  private drawn = 0;
  private readonly calm = matchMedia('(prefers-reduced-motion: reduce)');

  constructor(private readonly parts: Parts) {
    const { variables } = parts.vehicle;
    this.settings = new Settings(variables);
    this.outline = outline(parts.data);
    this.manoeuvres = parts.manoeuvres.map(parse);
    this.readout = new Readout(variables);
    this.strips = new Strips(variables, this.theme);
    this.map = new PoleMap(parts.published);
    this.simulator = this.start();
    this.adopt();
  }

  /** Connects the controls, takes the settings of the link, and begins to draw. */
  run(): void {
    connect(this.settings, this.parts.vehicle.variables, { vehicle: () => this.restart(), view: () => this.look() });
    button('play').addEventListener('click', () => this.play(!this.clock.playing));
    button('single').addEventListener('click', () => this.single());
    button('restart').addEventListener('click', () => this.restart());
    button('export').addEventListener('click', () => download(FILE, this.simulator.history.csv()));
    button('share').addEventListener('click', () => void this.share());
    for (const one of document.querySelectorAll<HTMLButtonElement>('[data-manoeuvre]')) {
      one.addEventListener('click', () => this.fly(Number(one.dataset['manoeuvre'])));
    }
    for (const one of document.querySelectorAll<HTMLButtonElement>('[data-release]')) {
      one.addEventListener('click', () => this.release(one.dataset['release'] as keyof typeof RELEASED));
    }
    for (const id of ['autopilot-row', 'autopilot-hint']) element(id, HTMLElement).hidden = !this.parts.autopilot;
    input('autopilot').addEventListener('change', () => this.engage(input('autopilot').checked));
    const keys = { ' ': () => this.play(!this.clock.playing), '.': () => this.single(), r: () => this.restart(), '0': () => this.centre(), '1': () => this.fly(1), '2': () => this.fly(2), '3': () => this.release('slosh'), '4': () => this.release('bend'), a: () => this.engage(!this.stick.autopilot) };
    onKeys(keys, (key) => this.stick.key(key));
    onThemeChange(() => {
      this.theme = theme();
      this.strips.recolour(this.theme);
      this.look();
    });
    new ResizeObserver(() => this.look()).observe(this.canvas);
    window.addEventListener('hashchange', () => this.open());
    this.open();
    requestAnimationFrame((now) => this.frame(now));
  }

  /** Settings of the link in the address. */
  private open(): void {
    const refused = this.settings.read(location.hash.slice(1));
    show(this.settings);
    const autopilot = this.settings.get('autopilot') === 1 && this.parts.autopilot !== undefined;
    input('autopilot').checked = autopilot;
    this.stick.use(autopilot);
    this.restart();
    if (refused.length > 0) this.say(`The link has settings that this page does not know: ${refused.join(', ')}`);
  }

  private start(): Simulator {
    return Simulator.start(this.parts.vehicle, this.parts.autopilot, {
      parameters: this.settings.parameters(),
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
    this.massCentre = vehicle.get('mass_centre');
    const { derivatives } = this.parts.vehicle.fmu;
    const configuration = this.settings.get('configuration');
    this.map.show(roots(vehicle, derivatives, configuration), configuration);
    const parameters = this.settings.parameters();
    const key = JSON.stringify(parameters);
    if (key !== this.sampled) this.sampling = sample(this.parts.vehicle, parameters, this.outline.length, STATIONS);
    this.sampled = key;
    const fuel = this.settings.get('fuel_fraction');
    if (fuel > 0) this.fullTanks = vehicle.get('fuel_mass') / fuel;
    this.look();
  }

  private play(playing: boolean): void {
    if (playing && !this.simulator.flying && !this.restart()) return;
    this.clock.playing = playing;
    if (playing) this.clock.start(this.simulator);
    button('play').textContent = playing ? 'Pause' : 'Play';
    this.look();
  }

  private single(): void {
    this.play(false);
    if (this.simulator.flying) this.simulator.step();
    this.check();
    this.look();
  }

  private fly(manoeuvre: number): void {
    this.engage(false);
    this.centre();
    this.settings.set('manoeuvre', manoeuvre);
    if (this.restart()) this.play(true);
  }

  /** Flies from a disturbed start, once. */
  private release(kind: keyof typeof RELEASED): void {
    this.centre();
    const offsets = Object.entries(RELEASED[kind]) as [keyof (typeof RELEASED)['slosh'], number][];
    for (const [name, value] of offsets) this.settings.set(name, value);
    if (this.restart()) this.play(true);
    for (const [name] of offsets) this.settings.set(name, 0);
  }

  private engage(autopilot: boolean): void {
    if (!this.parts.autopilot || autopilot === this.stick.autopilot) return;
    this.stick.use(autopilot);
    input('autopilot').checked = autopilot;
    this.settings.set('autopilot', Number(autopilot));
    this.centre();
    this.restart();
  }

  private centre(): void {
    this.stick.centre();
    this.steer();
  }

  /** By hand: a manoeuvre that is being flown is given up. */
  private steer(): void {
    this.settings.set('manoeuvre', 0);
    this.simulator.manoeuvre = undefined;
    this.command();
  }

  private command(): void {
    this.simulator.controls = { delta_e: this.stick.value('delta_e'), phi: this.stick.value('phi') };
    this.simulator.wanted = { V_change: this.stick.value('V_change'), gamma_wanted: this.stick.value('gamma_wanted') };
  }

  private look(): void {
    this.stale = true;
  }

  private frame(now: number): void {
    const flown = this.clock.fly(this.simulator, now, this.settings.get('speed'));
    if (flown) this.check();
    if (this.sampling) {
      const asked = this.sampling.next();
      if (asked.done) Object.assign(this, { shapes: asked.value, sampling: undefined, stale: true });
    }
    const drawn = flown && (!this.calm.matches || now - this.drawn > CALM_MS);
    if (drawn || this.stale) {
      this.drawn = now;
      this.show();
    }
    if (drawn) this.strips.showNext(this.simulator.history, this.settings.get('window'));
    if (this.stale) this.strips.showAll(this.simulator.history, this.settings.get('window'));
    this.stale = false;
    requestAnimationFrame((next) => this.frame(next));
  }

  /** Pauses where the flight has ended. */
  private check(): void {
    if (this.simulator.flying) return;
    this.play(false);
    this.say(this.simulator.ended ?? 'The history is full: save it, or restart.');
  }

  private show(): void {
    const { history } = this.simulator;
    const now: Pose = pose((name) => history.last(name), history.last('fuel_mass') / this.fullTanks);
    const look: Look = { shapes: this.shapes, magnified: this.settings.get('magnified'), liquid: this.settings.get('magnified') * LIQUID, massCentre: this.massCentre };
    const { lower_angle_rad: lower, upper_angle_rad: upper } = this.parts.data.outline;
    draw(this.canvas, this.outline, { lower, upper }, now, look, this.theme);
    this.readout.show(history);
    for (const name of ['delta_e', 'phi'] as const) {
      if (!this.stick.autopilot) this.stick.show(name, this.simulator.controls[name]!);
    }
    const rate = this.clock.playing ? `${shown(this.clock.rate(), 2)} frames/s` : '';
    element('rate', HTMLElement).textContent = rate;
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
