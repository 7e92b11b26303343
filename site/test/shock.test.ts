import assert from 'node:assert/strict';
import { test } from 'node:test';
import { shockAngle } from '../src/drawing/shock';

const DEGREE = Math.PI / 180;

test('shock angles are those of NACA Report 1135, chart 2', () => {
  for (const [mach, turn, angle] of [
    [2, 10, 39.31],
    [3, 20, 37.76],
  ] as const) {
    assert.ok(Math.abs(shockAngle(mach, turn * DEGREE)! / DEGREE - angle) < 0.01, `${mach}, ${turn}`);
  }
});

test('mass and tangential momentum are conserved across the shock', () => {
  const [mach, turn] = [8, 7.7 * DEGREE];
  const angle = shockAngle(mach, turn)!;
  const normal = (mach * Math.sin(angle)) ** 2;
  const density = (2.4 * normal) / (0.4 * normal + 2);
  assert.ok(Math.abs(Math.tan(angle) / Math.tan(angle - turn) - density) < 1e-12);
});

test('without a turn a shock is a Mach wave, and beyond the largest turn it is detached', () => {
  assert.equal(shockAngle(8, 0), Math.asin(1 / 8));
  assert.ok(shockAngle(2, 22.9 * DEGREE));
  assert.equal(shockAngle(2, 23.1 * DEGREE), undefined);
});
