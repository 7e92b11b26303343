import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { test } from 'node:test';
import ahv from 'virtual:ahv';
import { Component } from '../src/fmu/component';
import { Instance } from '../src/fmu/instance';
import { roots, type Root } from '../src/linear/roots';

const component = await Component.load(ahv);

interface Printed {
  poles: Root[];
  zeros: Root[];
}

/** What `cargo ahv poles --json` prints. */
function printed(settings: Record<string, number>): Printed {
  const set = Object.entries(settings).flatMap(([name, value]) => ['--set', `${name}=${value}`]);
  const [one] = JSON.parse(execFileSync(process.env['AHV_TOOL']!, ['poles', '--json', ...set], { encoding: 'utf8' }));
  return one;
}

const order = (list: Root[]): Root[] => [...list].sort((a, b) => a.re - b.re || a.im - b.im);

function assertNear(ours: Root[], theirs: Root[]): void {
  assert.equal(ours.length, theirs.length);
  const expected = order(theirs);
  let worst = 0;
  for (const [i, { re, im }] of order(ours).entries()) {
    worst = Math.max(worst, Math.abs(re - expected[i]!.re), Math.abs(im - expected[i]!.im));
  }
  assert.ok(worst < 1e-10, `${worst} rad/s`);
}

for (const settings of [
  { configuration: 1 },
  { configuration: 2, aero: 2 },
  { configuration: 3 },
  { configuration: 3, fuel_fraction: 0.35, slosh_damping: 0.02 },
  { configuration: 3, fuel_fraction: 0.8, slosh_frequency: 14.5, aero: 3 },
]) {
  test(`poles and zeros are those of the command line: ${JSON.stringify(settings)}`, () => {
    const instance = Instance.start(component, settings);
    const ours = roots(instance, ahv.derivatives, settings.configuration);
    const theirs = printed(settings);
    assertNear(ours.poles, theirs.poles);
    assertNear(ours.zeros, theirs.zeros);
    instance.free();
  });
}
