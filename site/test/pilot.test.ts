import assert from 'node:assert/strict';
import { test } from 'node:test';
import ahv from 'virtual:ahv';
import autopilot from 'virtual:ahv_autopilot';
import { Component } from '../src/fmu/component';
import { Simulator } from '../src/flight/simulator';

const skip = autopilot ? false : 'the page has no autopilot';

test('the autopilot holds level flight, then climbs as asked', { skip }, async () => {
  const [vehicle, pilot] = [await Component.load(ahv), await Component.load(autopilot!)];
  const parameters = { eta1_offset: 0.005 };
  const simulator = Simulator.start(vehicle, pilot, { parameters, step: 0.01, autopilot: true });
  while (simulator.time < 5) simulator.step();
  const { history } = simulator;
  assert.ok(Math.abs(history.last('gamma')) < 1e-4, String(history.last('gamma')));
  simulator.wanted = { V_change: 0, gamma_wanted: 0.01 };
  while (simulator.time < 80) simulator.step();
  assert.equal(simulator.ended, undefined);
  assert.ok(Math.abs(history.last('gamma') - 0.01) < 1e-3, String(history.last('gamma')));
  simulator.free();
});
