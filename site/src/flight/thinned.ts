// Columns for a picture, which has room for few points.

/**
 * At most about `most` points of a column, times `factor`: of many rows the least and the largest value, in their order,
 * so that no peak and no oscillation is lost.
 */
export function thinned(column: Float64Array, most: number, factor = 1): number[] {
  const rows = 2 * Math.ceil(column.length / most);
  if (column.length <= most) return Array.from(column, (value) => value * factor);
  const points: number[] = [];
  for (let start = 0; start < column.length; start += rows) {
    const end = Math.min(start + rows, column.length);
    let [least, largest] = [start, start];
    for (let row = start; row < end; row++) {
      if (column[row]! < column[least]!) least = row;
      if (column[row]! > column[largest]!) largest = row;
    }
    points.push(column[Math.min(least, largest)]! * factor, column[Math.max(least, largest)]! * factor);
  }
  return points;
}
