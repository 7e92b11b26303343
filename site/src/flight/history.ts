// The time history of a flight, and its CSV.

const FIRST_CAPACITY = 4096;

/** Columns that grow; the first is the time. */
export class History {
  private columns: Float64Array[];
  private rows = 0;

  constructor(
    readonly names: readonly string[],
    /** Most rows: about four hundred bytes each in memory, and five hundred of the CSV file. */
    readonly limit = 200_000,
  ) {
    this.columns = names.map(() => new Float64Array(FIRST_CAPACITY));
  }

  /** A flight that has been flown. */
  static of(names: readonly string[], columns: readonly number[][]): History {
    const history = new History(names);
    history.columns = columns.map((column) => Float64Array.from(column));
    history.rows = columns[0]!.length;
    return history;
  }

  get length(): number {
    return this.rows;
  }

  get full(): boolean {
    return this.rows >= this.limit;
  }

  add(time: number, values: Float64Array): void {
    if (this.rows === this.columns[0]!.length) {
      this.columns = this.columns.map((column) => {
        const larger = new Float64Array(2 * column.length);
        larger.set(column);
        return larger;
      });
    }
    this.columns[0]![this.rows] = time;
    for (let i = 0; i < values.length; i++) this.columns[i + 1]![this.rows] = values[i]!;
    this.rows += 1;
  }

  /** Values of a column, to be read before the next row is added. */
  column(name: string): Float64Array {
    return this.columns[this.names.indexOf(name)]!.subarray(0, this.rows);
  }

  /** The newest value of a column. */
  last(name: string): number {
    return this.value(name, this.rows - 1);
  }

  value(name: string, row: number): number {
    return this.columns[this.names.indexOf(name)]?.[row] ?? NaN;
  }

  /** Numbers read back exactly, in SI. */
  csv(): string {
    const lines = [this.names.join(',')];
    for (let row = 0; row < this.rows; row++) {
      lines.push(this.columns.map((column) => written(column[row]!)).join(','));
    }
    return `${lines.join('\n')}\n`;
  }
}

function written(value: number): string {
  return Object.is(value, -0) ? '-0' : String(value);
}
