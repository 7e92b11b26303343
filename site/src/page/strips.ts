// Live strips of the outputs.

import uPlot from 'uplot';
import { textSize, type Theme } from '../drawing/theme';
import type { History } from '../flight/history';
import { thinned } from '../flight/thinned';
import type { Variable } from '../fmu/variables';
import { element, shown } from './element';
import { OWN } from './settings';

/** Outputs of one strip have one unit. The first eight are shown if nothing else is chosen. */
const STRIPS: { title: string; names: string[] }[] = [
  { title: 'Angles', names: ['alpha', 'gamma', 'theta'] },
  { title: 'Pitch rate', names: ['q', 'q_imu'] },
  { title: 'Flexible modes', names: ['eta1', 'eta2', 'eta3'] },
  { title: 'Liquid', names: ['slosh1', 'slosh2'] },
  { title: 'Elevator', names: ['delta_e_effective'] },
  { title: 'Fuel ratio', names: ['phi_effective', 'choking_margin'] },
  { title: 'Load factor', names: ['n_z', 'n_z_imu', 'n_x_imu'] },
  { title: 'Airspeed', names: ['V'] },
  { title: 'Altitude', names: ['h'] },
  { title: 'Mach number', names: ['mach'] },
  { title: 'Dynamic pressure', names: ['qbar'] },
  { title: 'Forces', names: ['lift', 'drag', 'thrust'] },
  { title: 'Moment', names: ['moment'] },
  { title: 'Sensors', names: ['theta_imu', 'gamma_imu', 'alpha_probe'] },
];
/** Height of a strip, px: of a wide one more. */
const LEAST_HEIGHT = 150;
const HEIGHT_PER_WIDTH = 0.3;
/** Most points of a line: more are not seen. */
const MOST_POINTS = 1200;
/** Most strips that are drawn in one frame. */
const AT_ONCE = 2;
/** Shortest time that a strip shows, s. */
const SHORTEST_S = 0.1;
/** Least range of a strip, of the value and in its unit, so that rounding errors are not seen. */
const LEAST_RANGE = 1e-4;

class Strip {
  readonly figure = document.createElement('figure');
  private plot: uPlot | undefined;

  constructor(
    private readonly title: string,
    private readonly variables: Variable[],
  ) {
    this.figure.className = 'strip';
  }

  create(theme: Theme): void {
    this.plot?.destroy();
    const { unit } = this.variables[0]!.display;
    const axis = { stroke: theme.muted, grid: { stroke: theme.grid, width: 1 }, ticks: { stroke: theme.grid, width: 1 }, font: `${textSize(0.7)}px system-ui` };
    const series = this.variables.map(({ name }, i) => ({
      label: name,
      stroke: theme.lines[i]!,
      width: 1.5,
      dash: [[], [6, 3], [2, 3]][i] ?? [],
      points: { show: false },
      value: (_: uPlot, value: number | null) => (value === null ? '–' : shown(value, 5)),
    }));
    this.plot = new uPlot(
      {
        ...this.size(),
        title: unit === '1' ? this.title : `${this.title}, ${unit}`,
        cursor: { sync: { key: 'time' }, drag: { x: false, y: false } },
        scales: { x: { time: false, range: (_, low, high) => [low, Math.max(high, low + SHORTEST_S)] }, y: { range: (_, low, high) => padded(low, high) } },
        axes: [{ ...axis, size: textSize(1.5) }, { ...axis, size: textSize(3.9), values: (_, ticks) => ticks.map((tick) => shown(tick, 6)) }],
        series: [{ label: 'time, s', value: (_, value) => (value === null ? '–' : shown(value, 5)) }, ...series],
      },
      [[], ...this.variables.map(() => [])],
      this.figure,
    );
  }

  show(history: History, seconds: number): void {
    if (!this.plot || this.figure.hidden) return;
    const times = history.column('time');
    const first = lowerBound(times, history.last('time') - seconds);
    const lines = this.variables.map(({ name, display }) => thinned(history.column(name).subarray(first), MOST_POINTS, display.factor));
    // A single row has no extent: an end without values gives it one.
    const end = history.length > 1 ? [] : [history.last('time') + SHORTEST_S];
    this.plot.setData([[...thinned(times.subarray(first), MOST_POINTS), ...end], ...lines.map((line) => [...line, ...end.map(() => null)])]);
  }

  /** Puts the cursor at a time. */
  point(time: number): void {
    if (this.plot) this.plot.setCursor({ left: this.plot.valToPos(time, 'x'), top: -10 }, false);
  }

  resize(): void {
    const size = this.size();
    if (this.plot && this.plot.width !== size.width) this.plot.setSize(size);
  }

  private size(): { width: number; height: number } {
    const width = Math.max(220, this.figure.clientWidth);
    return { width, height: Math.max(LEAST_HEIGHT, Math.round(HEIGHT_PER_WIDTH * width)) };
  }
}

export class Strips {
  private readonly strips: { strip: Strip; box: HTMLInputElement; bit: number }[];
  private readonly seen = new Set<Element>();
  private readonly asked = new Set<Strip>();
  private turn = 0;

  /** `chosen` gets a bit for each strip that the user wants to see. */
  constructor(variables: ReadonlyMap<string, Variable>, theme: Theme, chosen: (shown: number) => void) {
    const [area, choice] = [element('strips', HTMLElement), element('shown-strips', HTMLElement)];
    const view = new IntersectionObserver((changes) => {
      for (const { target, isIntersecting } of changes) {
        if (isIntersecting) this.seen.add(target);
        else this.seen.delete(target);
      }
    });
    this.strips = STRIPS.flatMap(({ title, names }, i) => {
      const known = names.flatMap((name) => variables.get(name) ?? []);
      if (known.length === 0) return [];
      const strip = new Strip(title, known);
      const [label, box] = checkbox(title);
      box.addEventListener('change', () => {
        strip.figure.hidden = !box.checked;
        chosen(this.strips.reduce((bits, one) => bits + (one.box.checked ? one.bit : 0), 0));
      });
      area.append(strip.figure);
      choice.append(label);
      view.observe(strip.figure);
      return { strip, box, bit: 2 ** i };
    });
    this.choose(OWN.outputs.start);
    this.recolour(theme);
    new ResizeObserver(() => this.strips.forEach(({ strip }) => strip.resize())).observe(area);
  }

  /** Whether some that are asked for are not drawn yet. */
  get late(): boolean {
    return this.asked.size > 0;
  }

  /** Shows the strips whose bits are set. */
  choose(shown: number): void {
    for (const { strip, box, bit } of this.strips) {
      box.checked = (shown & bit) !== 0;
      strip.figure.hidden = !box.checked;
    }
  }

  recolour(theme: Theme): void {
    this.strips.forEach(({ strip }) => strip.create(theme));
  }

  /** All are to be drawn again. */
  ask(): void {
    for (const { strip } of this.strips) if (!strip.figure.hidden) this.asked.add(strip);
  }

  /** Draws a few, so that no frame of the vehicle is late: those that are asked for, else those in view in turn. */
  showNext(history: History, seconds: number): void {
    const seen = this.strips.filter(({ strip }) => this.seen.has(strip.figure));
    if (this.asked.size === 0) {
      for (let turn = 0; turn < Math.min(AT_ONCE, seen.length); turn++) this.asked.add(seen[this.turn++ % seen.length]!.strip);
    }
    for (const strip of [...this.asked].slice(0, AT_ONCE)) {
      strip.show(history, seconds);
      this.asked.delete(strip);
    }
  }

  point(time: number): void {
    this.strips.forEach(({ strip }) => strip.point(time));
  }

  showAll(history: History, seconds: number): void {
    this.strips.forEach(({ strip }) => strip.show(history, seconds));
    this.asked.clear();
  }
}

function checkbox(text: string): [HTMLLabelElement, HTMLInputElement] {
  const [label, box] = [document.createElement('label'), document.createElement('input')];
  box.type = 'checkbox';
  label.append(box, ` ${text}`);
  return [label, box];
}

/** A range that shows a constant as a line in the middle. */
function padded(low: number | null, high: number | null): [number, number] {
  if (low === null || high === null) return [0, 1];
  const middle = (low + high) / 2;
  const half = Math.max(0.55 * (high - low), LEAST_RANGE * Math.abs(middle), LEAST_RANGE);
  return [middle - half, middle + half];
}

/** The first index whose value is not less. */
function lowerBound(values: Float64Array, wanted: number): number {
  let [low, high] = [0, values.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle]! < wanted) low = middle + 1;
    else high = middle;
  }
  return low;
}
