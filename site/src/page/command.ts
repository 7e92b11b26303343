// The command line that flies the saved CSV with the library.

import type { Simulator } from '../flight/simulator';
import type { Variable } from '../fmu/variables';

export const FILE = 'ahv-flight.csv';

export function command({ experiment: { parameters, step }, time }: Simulator, variables: ReadonlyMap<string, Variable>): string {
  const set = Object.entries(parameters).map(([name, value]) => {
    const item = variables.get(name)?.items?.find((one) => one.value === value);
    return ` --set ${name}=${item?.name ?? value}`;
  });
  return `cargo ahv fly --input ${FILE} --step ${step}${time > 0 ? ` --stop ${time}` : ''}${set.join('')}`;
}
