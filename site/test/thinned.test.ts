import assert from 'node:assert/strict';
import { test } from 'node:test';
import { thinned } from '../src/flight/thinned';

test('of many rows the peaks remain, at the instants of their neighbours', () => {
  const times = Float64Array.from({ length: 100_000 }, (_, row) => row / 1000);
  const waves = times.map((time) => Math.sin(100 * time));
  waves[77_777] = 5;
  const [t, w] = [thinned(times, 1000), thinned(waves, 1000, 2)];
  assert.ok(t.length <= 1000 && t.length === w.length);
  assert.deepEqual([t[0], t.at(-1)], [0, 99.999]);
  assert.ok(t.every((time, i) => i === 0 || time >= t[i - 1]!));
  const peak = w.indexOf(10);
  assert.ok(Math.abs(t[peak]! - 77.777) < 0.2);
  assert.ok(w.filter((value) => value < -1.9).length > 300);
});

test('few rows remain as they are', () => {
  assert.deepEqual(thinned(Float64Array.of(3, 1, 2), 3, 10), [30, 10, 20]);
});
