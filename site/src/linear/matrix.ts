// Small dense matrices as rows.

export type Matrix = number[][];

export function zeros(rows: number, columns: number): Matrix {
  return Array.from({ length: rows }, () => new Array<number>(columns).fill(0));
}

export function pick(matrix: Matrix, rows: readonly number[], columns: readonly number[]): Matrix {
  return rows.map((row) => columns.map((column) => matrix[row]![column]!));
}

export function times(a: Matrix, b: Matrix): Matrix {
  const columns = b[0]?.length ?? 0;
  return a.map((row) =>
    Array.from({ length: columns }, (_, j) => row.reduce((sum, value, k) => sum + value * b[k]![j]!, 0)),
  );
}

/** a^-1 b for a 2 x 2 matrix; undefined if it is singular. */
export function solve2([[a, b], [c, d]]: [[number, number], [number, number]], right: Matrix): Matrix | undefined {
  const determinant = a * d - b * c;
  if (determinant === 0) return undefined;
  const [first, second] = right as [number[], number[]];
  return [
    first.map((value, j) => (d * value - b * second[j]!) / determinant),
    first.map((value, j) => (a * second[j]! - c * value) / determinant),
  ];
}

/**
 * Scales rows and columns by powers of two until their norms are alike, which changes no eigenvalue and loses
 * no digit (Parlett and Reinsch 1969).
 */
export function balance(matrix: Matrix): Matrix {
  const m = matrix.map((row) => [...row]);
  for (let again = true; again; ) {
    again = false;
    for (let i = 0; i < m.length; i++) {
      let column = 0;
      let row = 0;
      for (let j = 0; j < m.length; j++) {
        if (j === i) continue;
        column += Math.abs(m[j]![i]!);
        row += Math.abs(m[i]![j]!);
      }
      if (column === 0 || row === 0) continue;
      let factor = 1;
      const before = column + row;
      for (; column < row / 2; column *= 4) factor *= 2;
      for (; column >= row * 2; column /= 4) factor /= 2;
      if ((column + row) / factor >= 0.95 * before) continue;
      again = true;
      for (let j = 0; j < m.length; j++) {
        m[i]![j]! /= factor;
        m[j]![i]! *= factor;
      }
    }
  }
  return m;
}
