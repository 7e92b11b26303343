// What a picture of the vehicle shows, and where its points are on the screen.

import { deflection, type Shapes } from '../flight/shapes';
import type { Point } from './outline';

/** Variables of one instant, SI. */
export interface Pose {
  theta: number;
  gamma: number;
  mach: number;
  alpha_probe: number;
  eta: number[];
  slosh: number[];
  delta_e_effective: number;
  phi_effective: number;
  /** Part of the full tanks. */
  fuel: number;
}

/** Names of the variables that a pose is made of. */
export const SHOWN = [
  'theta',
  'gamma',
  'mach',
  'alpha_probe',
  'eta1',
  'eta2',
  'eta3',
  'slosh1',
  'slosh2',
  'delta_e_effective',
  'phi_effective',
] as const;

export function pose(value: (name: (typeof SHOWN)[number]) => number, fuel: number): Pose {
  return {
    theta: value('theta'),
    gamma: value('gamma'),
    mach: value('mach'),
    alpha_probe: value('alpha_probe'),
    eta: [value('eta1'), value('eta2'), value('eta3')],
    slosh: [value('slosh1'), value('slosh2')],
    delta_e_effective: value('delta_e_effective'),
    phi_effective: value('phi_effective'),
    fuel,
  };
}

/** From vehicle axes to the screen: bending, magnified; pitch about the mass centre; scale. */
export class View {
  private readonly sin: number;
  private readonly cos: number;

  constructor(
    pose: Pose,
    private readonly shapes: Shapes | undefined,
    private readonly magnified: number,
    private readonly pivot: number,
    private readonly centre: Point,
    readonly scale: number,
  ) {
    this.eta = pose.eta;
    this.sin = Math.sin(pose.theta);
    this.cos = Math.cos(pose.theta);
  }

  private readonly eta: number[];

  /** Screen coordinates of a point of the vehicle. */
  place([x, z]: Point): Point {
    const bend = this.shapes ? deflection(this.shapes, this.eta, x) : 0;
    const up = z + this.magnified * bend;
    const aft = x - this.pivot;
    return [
      this.centre[0] + this.scale * (aft * this.cos + up * this.sin),
      this.centre[1] - this.scale * (up * this.cos - aft * this.sin),
    ];
  }

  /** A point at a distance in a direction above the horizon, aft of a point on the screen. */
  aft([x, y]: Point, distance: number, angle: number): Point {
    return [x + this.scale * distance * Math.cos(angle), y - this.scale * distance * Math.sin(angle)];
  }
}
