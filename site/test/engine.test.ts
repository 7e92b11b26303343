import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import ahv from 'virtual:ahv';
import manoeuvres from 'virtual:manoeuvres';
import { Component } from '../src/fmu/component';
import { Instance, Refused } from '../src/fmu/instance';
import { parse } from '../src/flight/manoeuvre';
import { Simulator } from '../src/flight/simulator';

const component = await Component.load(ahv);
const level = { parameters: {}, step: 0.01, autopilot: false };

test('the reference manoeuvre has the bits of the library, row by row', () => {
  const file = `${process.env['AHV_FMU']}/documentation/cross-check/ahv_ref.csv`;
  const [head, ...rows] = readFileSync(file, 'utf8').trim().split('\n').map((line) => line.split(','));
  const simulator = Simulator.start(component, undefined, level);
  simulator.manoeuvre = parse(manoeuvres[0]!);
  while (simulator.time < 2) simulator.step();
  const { history } = simulator;
  const columns = head!.map((name) => [...history.column(name)]);
  // The reference has the row before a jump alone.
  const times = [...history.column('time')];
  const first = times.flatMap((time, row) => (time === times[row - 1] ? [] : [row]));
  assert.equal(first.length, rows.length);
  for (const [n, row] of first.entries()) {
    assert.deepEqual(columns.map((column) => column[row]), rows[n]!.map(Number), `row ${n}`);
  }
  simulator.free();
});

test('a refusal has the message of the FMU', () => {
  const start = (parameters: Record<string, number>) => () => Instance.start(component, parameters);
  assert.throws(start({ mach0: 2 }), (error) => error instanceof Refused && /no trim at mach0 = 2/.test(error.message));
  assert.throws(start({ fuel_fraction: 2 }), /fuel_fraction = 2 is refused: the range is \[0, 1\]/);
});

test('a flight out of the envelope ends with the reason and the last valid values', () => {
  const simulator = Simulator.start(component, undefined, level);
  simulator.controls = { delta_e: 0.05, phi: 0 };
  while (simulator.flying) simulator.step();
  assert.match(simulator.ended!, /alpha/);
  assert.ok(Number.isFinite(simulator.history.last('alpha')));
  assert.equal(simulator.history.last('time'), simulator.time);
  simulator.free();
});

test('a refused input ends the flight with the message of the FMU, and keeps the history', () => {
  const simulator = Simulator.start(component, undefined, level);
  simulator.step();
  simulator.controls = { delta_e: NaN, phi: 0 };
  simulator.step();
  assert.match(simulator.ended!, /delta_e = NaN/);
  assert.equal(simulator.history.last('time'), 0.01);
  simulator.free();
});

test('a saved state flies on with the same bits', () => {
  const one = Instance.start(component, { slosh1_offset: 0.02 });
  one.stepTo(0.1);
  const saved = one.state();
  one.stepTo(0.2);
  const other = Instance.start(component, {});
  other.restore(saved);
  other.stepTo(0.2);
  const names = ['V', 'alpha', 'eta1', 'eta3', 'slosh1', 'slosh2'];
  assert.deepEqual(other.read(other.references(names)), one.read(one.references(names)));
  one.free();
  other.free();
});
