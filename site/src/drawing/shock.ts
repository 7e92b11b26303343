// Angle of an oblique shock: the theta-beta-M relation (NACA Report 1135, equation 150), weak solution.

const GAMMA = 1.4;

/** Angle between shock and stream, rad, for a stream that turns by `turn`; undefined if the shock is detached. */
export function shockAngle(mach: number, turn: number): number | undefined {
  const mu = Math.asin(1 / mach);
  if (turn <= 0) return mu;
  const turned = (beta: number): number => {
    const normal = (mach * Math.sin(beta)) ** 2;
    return Math.atan((2 / Math.tan(beta)) * ((normal - 1) / (mach ** 2 * (GAMMA + Math.cos(2 * beta)) + 2)));
  };
  const m2 = mach ** 2;
  // Where the turn is largest (equation 168).
  const strongest = Math.asin(
    Math.sqrt(
      (((GAMMA + 1) / 4) * m2 - 1 + Math.sqrt((GAMMA + 1) * (((GAMMA + 1) / 16) * m2 ** 2 + ((GAMMA - 1) / 2) * m2 + 1))) /
        (GAMMA * m2),
    ),
  );
  if (turned(strongest) < turn) return undefined;
  let [low, high] = [mu, strongest];
  for (let i = 0; i < 50; i++) {
    const middle = (low + high) / 2;
    if (turned(middle) < turn) low = middle;
    else high = middle;
  }
  return (low + high) / 2;
}
