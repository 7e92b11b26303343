// Live strips of the outputs.

import uPlot from 'uplot';
import type { Theme } from '../drawing/theme';
import type { History } from '../flight/history';
import type { Variable } from '../fmu/variables';
import { element, shown } from './element';

/** Outputs of one strip have one unit. */
const STRIPS: { title: string; names: string[]; hidden?: true }[] = [
  { title: 'Angles', names: ['alpha', 'gamma', 'theta'] },
  { title: 'Pitch rate', names: ['q', 'q_imu'] },
  { title: 'Flexible modes', names: ['eta1', 'eta2', 'eta3'] },
  { title: 'Liquid', names: ['slosh1', 'slosh2'] },
  { title: 'Elevator', names: ['delta_e_effective'] },
  { title: 'Fuel ratio', names: ['phi_effective', 'choking_margin'] },
  { title: 'Load factor', names: ['n_z', 'n_z_imu', 'n_x_imu'] },
  { title: 'Airspeed', names: ['V'] },
  { title: 'Altitude', names: ['h'], hidden: true },
  { title: 'Mach number', names: ['mach'], hidden: true },
  { title: 'Dynamic pressure', names: ['qbar'], hidden: true },
  { title: 'Forces', names: ['lift', 'drag', 'thrust'], hidden: true },
  { title: 'Moment', names: ['moment'], hidden: true },
  { title: 'Sensors', names: ['theta_imu', 'gamma_imu', 'alpha_probe'], hidden: true },
];
/** Height of a strip, px: of a wide one more. */
const LEAST_HEIGHT = 150;
const HEIGHT_PER_WIDTH = 0.3;
/** Most points of a line: more are not seen. */
const MOST_POINTS = 1200;
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
    const axis = { stroke: theme.muted, grid: { stroke: theme.grid, width: 1 }, ticks: { stroke: theme.grid, width: 1 }, font: '11px system-ui' };
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
        axes: [{ ...axis, size: 24 }, { ...axis, size: 62, values: (_, ticks) => ticks.map((tick) => shown(tick, 6)) }],
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
    const stride = Math.ceil((times.length - first) / MOST_POINTS);
    const thin = (column: Float64Array, factor: number): number[] => {
      const points: number[] = [];
      for (let row = first; row < column.length; row += stride) points.push(column[row]! * factor);
      return points;
    };
    const lines = this.variables.map(({ name, display }) => thin(history.column(name), display.factor));
    // A single row has no extent: an end without values gives it one.
    const end = history.length > 1 ? [] : [history.last('time') + SHORTEST_S];
    this.plot.setData([[...thin(times, 1), ...end], ...lines.map((line) => [...line, ...end.map(() => null)])]);
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
  private readonly strips: Strip[];
  private next = 0;

  constructor(variables: ReadonlyMap<string, Variable>, theme: Theme) {
    const [area, choice] = [element('strips', HTMLElement), element('shown-strips', HTMLElement)];
    const known = (names: string[]): Variable[] => names.flatMap((name) => variables.get(name) ?? []);
    this.strips = STRIPS.filter(({ names }) => known(names).length > 0).map(({ title, names, hidden }) => {
      const strip = new Strip(title, known(names));
      area.append(strip.figure);
      strip.figure.hidden = hidden ?? false;
      choice.append(checkbox(title, !hidden, (on) => (strip.figure.hidden = !on)));
      return strip;
    });
    this.recolour(theme);
    new ResizeObserver(() => this.strips.forEach((strip) => strip.resize())).observe(area);
  }

  recolour(theme: Theme): void {
    this.strips.forEach((strip) => strip.create(theme));
  }

  /** One strip after the other, so that no frame of the vehicle is late. */
  showNext(history: History, seconds: number): void {
    const visible = this.strips.filter(({ figure }) => !figure.hidden);
    if (visible.length === 0) return;
    this.next = (this.next + 1) % visible.length;
    visible[this.next]!.show(history, seconds);
  }

  point(time: number): void {
    this.strips.forEach((strip) => strip.point(time));
  }

  showAll(history: History, seconds: number): void {
    this.strips.forEach((strip) => strip.show(history, seconds));
  }
}

function checkbox(text: string, checked: boolean, changed: (on: boolean) => void): HTMLLabelElement {
  const [label, box] = [document.createElement('label'), document.createElement('input')];
  Object.assign(box, { type: 'checkbox', checked });
  box.addEventListener('change', () => changed(box.checked));
  label.append(box, ` ${text}`);
  return label;
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
