import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { accessible, Chromium, environment, table } from './browser';

const chromium = await Chromium.start();
after(() => chromium.close());

/** A flight page of `cargo ahv fly`. */
function flown(...options: string[]): string {
  const folder = mkdtempSync(join(tmpdir(), 'ahv-'));
  // A flight that ends early is an error of the command, and has its page.
  spawnSync(environment('AHV_TOOL'), ['fly', '--fmu', environment('AHV_PACKAGE'), '--output', folder, ...options]);
  return folder;
}

test('the page of a flight has its numbers, and shows them at the time of the slider', async () => {
  const folder = flown();
  const file = join(folder, 'flight.html');
  assert.ok(statSync(file).size < 3e6);
  const { names, rows } = table(readFileSync(join(folder, 'flight.csv'), 'utf8'));
  await chromium.visit(file, async (page) => {
    const data = JSON.parse((await page.locator('#data').textContent())!) as { names: string[]; columns: number[][] };
    assert.deepEqual(data.names, names);
    assert.deepEqual(data.columns, names.map((_, column) => rows.map((row) => row[column])));
    await page.locator('#time').fill('1.205');
    const value = page.locator('#readout div', { hasText: 'Pitch rate' }).locator('dd');
    const row = rows.find(([time]) => time === 1.2)!;
    const shown = Number((await value.textContent())!.replace('−', '-'));
    assert.ok(Math.abs(shown - (row[names.indexOf('q')]! * 180) / Math.PI) < 1e-3);
    await page.keyboard.press('.');
    assert.equal(await page.locator('#time').inputValue(), '1.21');
    // The elevator jumps at 0.5 s, where there are two rows.
    await page.locator('#time').fill('0.51');
    for (const time of ['0.5', '0.49']) {
      await page.keyboard.press(',');
      assert.equal(await page.locator('#time').inputValue(), time);
    }
    await page.locator('#speed').selectOption('4');
    await page.getByRole('button', { name: 'Play' }).click();
    await page.locator('#readout dd').first().filter({ hasText: /^2$/ }).waitFor();
    assert.deepEqual(await accessible(page), []);
  });
});

test('the page says why a flight ended, and what was set', async () => {
  const file = join(flown('--set', 'slosh1_offset=0.1', '--step', '0.001', '--stop', '5'), 'flight.html');
  await chromium.visit(file, async (page) => {
    assert.match((await page.locator('#message').textContent())!, /alpha = .* reached the edge of its valid range/);
    assert.match((await page.locator('#set').textContent())!, /slosh1_offset0\.1as set/);
    assert.match((await page.locator('#summary').textContent())!, /5 s in steps of 0\.001 s/);
  }, { viewport: { width: 400, height: 800 } });
});

test('a long flight is thinned, and the page says so', async () => {
  const file = join(flown('--step', '0.0001', '--stop', '1'), 'flight.html');
  assert.ok(statSync(file).size < 3e6);
  await chromium.visit(file, async (page) => {
    assert.match((await page.locator('#summary').textContent())!, /This page has \d+ of 100\d\d rows; flight\.csv has all\./);
    assert.equal(await page.locator('#time').getAttribute('max'), '1');
  });
});
