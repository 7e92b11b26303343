// Shows the flight: the vehicle in every frame, numbers as often as one can read them, strips in turn.

import type { VehicleData } from '../data';
import { outline, type Outline } from '../drawing/outline';
import { pose } from '../drawing/pose';
import { draw } from '../drawing/scene';
import { onThemeChange, theme, type Theme } from '../drawing/theme';
import type { Shapes } from '../flight/shapes';
import type { Simulator } from '../flight/simulator';
import type { Variable } from '../fmu/variables';
import { LIQUID } from './controls';
import { element } from './element';
import { Readout } from './readout';
import type { Settings } from './settings';
import { Strips } from './strips';

/** Time between frames for those who want little motion, ms. */
const CALM_MS = 500;
/** Time between numbers, ms. */
const READ_MS = 100;
/** Frames from strips to strips: with vehicle and strips new, the browser puts the whole screen together again. */
const STRIPS_EVERY = 3;

export class Display {
  shapes: Shapes | undefined;
  /** Station of the mass centre, m. */
  massCentre = 0;
  /** Fuel of full tanks, kg/m. */
  fullTanks = 1;
  private readonly outline: Outline;
  private readonly readout: Readout;
  private readonly strips: Strips;
  private readonly canvas = element('scene', HTMLCanvasElement);
  private readonly calm = matchMedia('(prefers-reduced-motion: reduce)');
  private theme: Theme = theme();
  private stale = true;
  private drawn = 0;
  private written = 0;
  private frames = 0;

  constructor(
    private readonly data: VehicleData,
    variables: ReadonlyMap<string, Variable>,
    private readonly settings: Settings,
  ) {
    this.outline = outline(data);
    this.readout = new Readout(variables);
    this.strips = new Strips(variables, this.theme, (shown) => {
      settings.set('outputs', shown);
      this.look();
    });
    onThemeChange(() => {
      this.theme = theme();
      this.strips.recolour(this.theme);
      this.look();
    });
    new ResizeObserver(() => this.look()).observe(this.canvas);
  }

  /** Everything is to be shown again. */
  look(): void {
    this.stale = true;
  }

  /** Shows the outputs that the settings name. */
  choose(): void {
    this.strips.choose(this.settings.get('outputs'));
    this.look();
  }

  /** A frame; whether numbers beside the flight are due. */
  frame(simulator: Simulator, now: number, flown: boolean): boolean {
    const { stale } = this;
    const due = stale || (flown && (!this.calm.matches || now - this.drawn > CALM_MS));
    if (stale || (due && this.calm.matches)) this.strips.ask();
    const strips = (due || this.strips.late) && ++this.frames % STRIPS_EVERY === 0;
    if (strips) this.strips.showNext(simulator.history, this.settings.get('window'));
    if (!due) return false;
    this.stale = false;
    this.drawn = now;
    this.vehicle(simulator);
    if (!stale && now - this.written < READ_MS) return false;
    this.written = now;
    this.readout.show(simulator.history);
    return true;
  }

  private vehicle({ history }: Simulator): void {
    const magnified = this.settings.get('magnified');
    const now = pose((name) => history.last(name), history.last('fuel_mass') / this.fullTanks);
    const look = { shapes: this.shapes, magnified, liquid: magnified * LIQUID, massCentre: this.massCentre };
    const { lower_angle_rad: lower, upper_angle_rad: upper } = this.data.outline;
    draw(this.canvas, this.outline, { lower, upper }, now, look, this.theme);
  }
}
