// The data files that the page draws and compares with.

export interface Tank {
  name: string;
  centre_m: number;
  length_m: number;
  depth_full_m: number;
}

/** vehicle.toml, values alone. */
export interface VehicleData {
  geometry: { length_m: number; fore_body_m: number; nacelle_m: number };
  outline: {
    lower_angle_rad: number;
    upper_angle_rad: number;
    elevator_station_m: number;
    elevator_height_m: number;
    elevator_area_m2_per_m: number;
  };
  engine: { duct_height_m: number };
  tank: Tank[];
}

type Pair = [number, number];

/** published.toml: tables 2 and 3 of the paper, rad/s. */
export interface Published {
  table2: Record<
    'rigid' | 'even' | 'slosh',
    { long_term: Pair; short_term: Pair; height: number; aeroelastic?: Pair[] }
  >;
  table3: Record<'rigid' | 'even' | 'slosh', { real: number[]; aeroelastic?: Pair[] }>;
}
