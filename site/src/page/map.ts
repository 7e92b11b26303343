// Pole-zero map of the trimmed vehicle, with the values that the paper prints.

import type { Published } from '../data';
import { textSize } from '../drawing/theme';
import type { Root, Roots } from '../linear/roots';
import { element, shown } from './element';

const NAMES: Record<number, keyof Published['table2']> = { 1: 'rigid', 2: 'even', 3: 'slosh' };
/** Windows of the map, rad/s. */
const WINDOWS: { re: [number, number]; im: [number, number] }[] = [
  { re: [-9, 9], im: [0, 125] },
  { re: [-2, 0.5], im: [0, 30] },
  { re: [-0.002, 0.002], im: [0, 0.06] },
];
/** Size of the text, as a part of that of the page. */
const TEXT = 0.75;
/** Left, right, top and bottom, in sizes of the text. */
const MARGINS = [4.3, 1.2, 1, 3.4];
/** Former roots that stay as a trail. */
const MOST_FORMER = 1500;
const SIZE = 5;

type Kind = 'pole' | 'zero' | 'printed-pole' | 'printed-zero';

export class PoleMap {
  private readonly svg = document.getElementById('roots-map') as unknown as SVGSVGElement;
  private readonly table = element('roots', HTMLTableSectionElement);
  private roots: Roots = { poles: [], zeros: [] };
  private former: Root[] = [];
  private configuration = 3;
  private window = 0;

  constructor(private readonly published: Published) {
    element('map-clear', HTMLButtonElement).addEventListener('click', () => {
      this.former = [];
      this.draw();
    });
    new ResizeObserver(() => this.draw()).observe(this.svg);
  }

  show(roots: Roots, configuration: number): void {
    if (configuration === this.configuration) this.former.push(...this.roots.poles, ...this.roots.zeros);
    else this.former = [];
    this.former.splice(0, this.former.length - MOST_FORMER);
    Object.assign(this, { roots, configuration });
    this.draw();
    this.list();
  }

  /** Another window, by its number. */
  look(window: number): void {
    this.window = window;
    this.draw();
  }

  private draw(): void {
    const { clientWidth: width, clientHeight: height } = this.svg;
    if (width === 0) return;
    const { re, im } = WINDOWS[this.window]!;
    const text = textSize(TEXT);
    const [left, right, top, bottom] = MARGINS.map((part) => part * text) as [number, number, number, number];
    const x = (value: number): number => left + ((value - re[0]) / (re[1] - re[0])) * (width - left - right);
    const y = (value: number): number => height - bottom - ((value - im[0]) / (im[1] - im[0])) * (height - top - bottom);
    this.svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
    const inside = ({ re: a, im: b }: Root): boolean => a >= re[0] && a <= re[1] && b >= im[0] && b <= im[1];
    const marks = (kind: Kind, list: readonly Root[]): string =>
      list.filter(inside).map((root) => mark(kind, x(root.re), y(root.im), root)).join('');
    const printed = this.printed();
    this.svg.innerHTML = [
      ticks(re, x, (at, value) => `<path class="grid" d="M${at} ${top}V${height - bottom}"/><text x="${at}" y="${height - bottom + 1.3 * text}" text-anchor="middle">${value}</text>`),
      ticks(im, y, (at, value) => `<path class="grid" d="M${left} ${at}H${width - right}"/><text x="${left - text / 2}" y="${at + text / 3}" text-anchor="end">${value}</text>`),
      `<path class="axis" d="M${x(0)} ${top}V${height - bottom}"/>`,
      `<text x="${(left + width) / 2}" y="${height - text / 2}" text-anchor="middle">real part, rad/s</text>`,
      `<text transform="translate(${text} ${height / 2}) rotate(-90)" text-anchor="middle">imaginary part, rad/s</text>`,
      `<path class="former" d="${this.former.filter(inside).map((root) => `M${x(root.re).toFixed(1)} ${y(root.im).toFixed(1)}h0`).join('')}"/>`,
      marks('printed-pole', printed.poles),
      marks('printed-zero', printed.zeros),
      marks('zero', this.roots.zeros),
      marks('pole', this.roots.poles),
    ].join('');
  }

  /** Tables 2 and 3 for this configuration. */
  private printed(): Roots {
    const name = NAMES[this.configuration]!;
    const [poles, zeros] = [this.published.table2[name], this.published.table3[name]];
    const pairs = (list: [number, number][] = []): Root[] => list.map(([re, im]) => ({ re, im }));
    const real = (list: number[]): Root[] => list.map((re) => ({ re, im: 0 }));
    return {
      poles: [...pairs([poles.long_term]), ...real([...poles.short_term, poles.height]), ...pairs(poles.aeroelastic)],
      zeros: [...real(zeros.real), ...pairs(zeros.aeroelastic)],
    };
  }

  private list(): void {
    const row = (kind: string) => (root: Root) => {
      const line = document.createElement('tr');
      Object.assign(line.dataset, { kind, re: String(root.re), im: String(root.im) });
      const frequency = Math.hypot(root.re, root.im);
      for (const text of [kind, shown(root.re, 5), root.im ? `±${shown(root.im, 5)}` : '', shown(frequency / (2 * Math.PI), 4), frequency > 1e-5 ? shown(-root.re / frequency, 3) : '']) {
        line.insertCell().textContent = text;
      }
      return line;
    };
    this.table.replaceChildren(...this.roots.poles.map(row('pole')), ...this.roots.zeros.map(row('zero')));
  }
}

function mark(kind: Kind, x: number, y: number, root: Root): string {
  const cross = `M${x - SIZE} ${y - SIZE}L${x + SIZE} ${y + SIZE}M${x - SIZE} ${y + SIZE}L${x + SIZE} ${y - SIZE}`;
  const plus = `M${x - SIZE} ${y}H${x + SIZE}M${x} ${y - SIZE}V${y + SIZE}`;
  const shapes: Record<Kind, string> = {
    pole: `<path d="${cross}"/>`,
    zero: `<circle cx="${x}" cy="${y}" r="${SIZE}"/>`,
    'printed-pole': `<path d="${plus}"/>`,
    'printed-zero': `<path d="M${x} ${y - SIZE}L${x + SIZE} ${y}L${x} ${y + SIZE}L${x - SIZE} ${y}Z"/>`,
  };
  const text = `${kind.replace('printed-', 'paper: ')} ${shown(root.re, 5)}${root.im ? ` ± ${shown(root.im, 5)}i` : ''} rad/s`;
  return `<g class="${kind}"><title>${text}</title>${shapes[kind]}</g>`;
}

/** Round numbers in a range. */
function ticks([low, high]: [number, number], place: (value: number) => number, drawn: (at: number, text: string) => string): string {
  const rough = (high - low) / 5;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((n) => n * power).find((size) => size >= rough)!;
  const first = Math.ceil(low / step);
  const count = Math.floor(high / step) - first + 1;
  return Array.from({ length: count }, (_, i) => (first + i) * step)
    .map((value) => drawn(place(value), shown(value, 3)))
    .join('');
}
