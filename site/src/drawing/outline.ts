// The vehicle's shape in its own axes: x aft of the nose, z up, m. To scale, from the data file.

import type { Tank, VehicleData } from '../data';

export type Point = [x: number, z: number];

export interface Outline {
  length: number;
  body: Point[];
  nacelle: Point[];
  elevator: { hinge: Point; half: number };
  tanks: { name: string; floor: Point[]; roof: Point[] }[];
  /** Trailing edge of the nacelle. */
  lip: Point;
  /** Where the aft-body begins. */
  shoulder: Point;
  tail: Point;
}

/** Most distance between points, m, so that a bent outline is smooth. */
const STEP_M = 0.5;
/** Skin between tank and outline, as drawn, m. */
const INSET_M = 0.12;

export function outline({ geometry, outline: shape, engine, tank }: VehicleData): Outline {
  const { length_m: length, fore_body_m: fore, nacelle_m } = geometry;
  const rise = Math.tan(shape.upper_angle_rad);
  const behind = fore + nacelle_m;
  const shoulder = -fore * Math.tan(shape.lower_angle_rad);
  const tail: Point = [length, length * rise];
  const upper = (x: number): number => x * rise;
  const lower = (x: number): number => {
    if (x < fore) return (x / fore) * shoulder;
    return x < behind ? shoulder : shoulder + ((x - behind) / (length - behind)) * (tail[1] - shoulder);
  };
  const lip = shoulder - engine.duct_height_m;
  const nose: Point = [0, 0];
  return {
    length,
    body: dense([nose, [fore, shoulder], [behind, shoulder], tail, nose]),
    nacelle: dense([
      [fore, lip],
      [behind, lip],
    ]),
    elevator: {
      hinge: [shape.elevator_station_m, shape.elevator_height_m],
      half: shape.elevator_area_m2_per_m / 2,
    },
    tanks: tank.map((one) => ({
      name: one.name,
      floor: along(one, (x) => lower(x) + INSET_M),
      roof: along(one, (x) => upper(x) - INSET_M),
    })),
    lip: [behind, lip],
    shoulder: [behind, shoulder],
    tail,
  };
}

function along(tank: Tank, height: (x: number) => number): Point[] {
  const count = Math.ceil(tank.length_m / STEP_M);
  return Array.from({ length: count + 1 }, (_, i) => {
    const x = tank.centre_m + (i / count - 0.5) * tank.length_m;
    return [x, height(x)];
  });
}

function dense(corners: Point[]): Point[] {
  return corners.flatMap((to, i) => {
    const from = corners[i - 1];
    if (!from) return [to];
    const count = Math.ceil(Math.hypot(to[0] - from[0], to[1] - from[1]) / STEP_M);
    return Array.from({ length: count }, (_, k): Point => {
      const share = (k + 1) / count;
      return [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])];
    });
  });
}
