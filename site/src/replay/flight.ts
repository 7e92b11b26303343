// The data of a flight page, as `cargo ahv fly` writes them.

import type { VehicleData } from '../data';
import type { Shapes } from '../flight/shapes';
import type { Variable } from '../fmu/variables';

export interface FlightData {
  title: string;
  /** About experiment and file. */
  summary: string;
  /** Why the flight ended early, or an empty text. */
  ended: string;
  vehicle: VehicleData;
  shapes: Shapes | null;
  /** Station of the mass centre, m. */
  mass_centre_m: number;
  /** Fuel of full tanks, kg/m. */
  full_tanks_kg_per_m: number;
  variables: Pick<Variable, 'name' | 'unit' | 'display'>[];
  /** Parameters as name, value and unit. */
  set: [string, string, string][];
  /** Names of the columns, time first. */
  names: string[];
  /** Rows of every column, SI. */
  columns: number[][];
}
