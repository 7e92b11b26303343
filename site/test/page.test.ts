import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import type { Page } from 'playwright-core';
import autopilot from 'virtual:ahv_autopilot';
import { accessible, Chromium, environment, saved, slide, table } from './browser';

/** The page with settings in its link. */
const page = (link: string): string => `${environment('AHV_PAGE')}${link}`;
const chromium = await Chromium.start();
after(() => chromium.close());
const cargoAhv = (...options: string[]): string => execFileSync(environment('AHV_TOOL'), options, { encoding: 'utf8' });

test('the reference manoeuvre, step by step with the keyboard, has the bits of the library', async () => {
  await chromium.visit(page('#step=0.01&manoeuvre=1'), async (page) => {
    for (let step = 0; step < 200; step++) await page.keyboard.press('.');
    const flown = table(await saved(page));
    const reference = table(readFileSync(join(environment('AHV_FMU'), 'documentation/cross-check/ahv_ref.csv'), 'utf8'));
    const last = (name: string): number => flown.rows.at(-1)![flown.names.indexOf(name)]!;
    assert.deepEqual(reference.names.map(last), reference.rows.at(-1));
  });
});

test('`cargo ahv fly` flies the saved CSV with the same numbers', async () => {
  await chromium.visit(page('#fuel_fraction=0.6&configuration=3'), async (page) => {
    for (const [id, value] of [['delta_e', 0.1], ['phi', 0.05], ['delta_e', -0.2]] as const) {
      for (let step = 0; step < 40; step++) await page.keyboard.press('.');
      await slide(page, id, value);
    }
    await page.locator('h1').click();
    for (let step = 0; step < 40; step++) await page.keyboard.press('.');
    const csv = await saved(page);
    const folder = mkdtempSync(join(tmpdir(), 'ahv-'));
    writeFileSync(join(folder, 'ahv-flight.csv'), csv);
    const [, ...command] = (await page.locator('#command').textContent())!.replace('ahv-flight.csv', join(folder, 'ahv-flight.csv')).split(' ');
    cargoAhv(...command.slice(1), '--fmu', environment('AHV_PACKAGE'), '--output', folder);
    const [ours, theirs] = [table(csv), table(readFileSync(join(folder, 'flight.csv'), 'utf8'))];
    assert.deepEqual(theirs.names, ours.names);
    assert.equal(theirs.rows.length, ours.rows.length);
    assert.deepEqual(theirs.rows, ours.rows);
  });
});

test('poles and zeros follow the fuel, and are those of `cargo ahv poles`', async () => {
  await chromium.visit(page(''), async (page) => {
    for (const fuel of [0.9, 0.35]) {
      await slide(page, 'fuel_fraction', fuel);
      const [printed] = JSON.parse(cargoAhv('poles', '--json', '--set', `fuel_fraction=${fuel}`));
      for (const kind of ['pole', 'zero'] as const) {
        const shown = await rootsOf(page, kind);
        const expected = (printed[`${kind}s`] as { re: number; im: number }[]).toSorted(byValue);
        assert.equal(shown.length, expected.length);
        for (const [i, { re, im }] of shown.entries()) {
          assert.ok(Math.hypot(re - expected[i]!.re, im - expected[i]!.im) < 1e-10, `${fuel}, ${kind} ${re} ${im}`);
        }
      }
    }
  });
});

const byValue = (a: { re: number; im: number }, b: { re: number; im: number }): number => a.re - b.re || a.im - b.im;

async function rootsOf(page: Page, kind: string): Promise<{ re: number; im: number }[]> {
  const rows = await page.locator(`#roots tr[data-kind=${kind}]`).evaluateAll((list) =>
    list.map((row) => ({ re: Number((row as HTMLElement).dataset['re']), im: Number((row as HTMLElement).dataset['im']) })),
  );
  return rows.sort(byValue);
}

test('the keyboard alone flies the vehicle', async () => {
  await chromium.visit(page(''), async (page) => {
    await page.keyboard.press('ArrowUp');
    assert.equal(await page.locator('#delta_e').inputValue(), '-0.05');
    await page.keyboard.press('ArrowRight');
    assert.equal(await page.locator('#phi').inputValue(), '0.025');
    await page.keyboard.press('0');
    assert.equal(await page.locator('#delta_e').inputValue(), '0');
    await page.keyboard.press(' ');
    await page.getByRole('button', { name: 'Pause' }).waitFor();
    await page.keyboard.press(' ');
    await page.getByRole('button', { name: 'Play' }).waitFor();
    await page.keyboard.press('r');
    await page.locator('#readout dd').first().filter({ hasText: /^0$/ }).waitFor();
    const reached = new Set<string>();
    for (let tab = 0; tab < 60; tab++) {
      await page.keyboard.press('Tab');
      reached.add(await page.evaluate(() => document.activeElement?.id ?? ''));
    }
    const ids = await page.locator('#flight :is(input, select, button)[id]:visible').evaluateAll((list) => list.map(({ id }) => id));
    assert.ok(ids.length > 15);
    assert.deepEqual(ids.filter((id) => !reached.has(id)), []);
  });
});

test('a vehicle without a trim shows the message of the FMU where one is, and the last one flies on', async () => {
  await chromium.visit(page(''), async (page) => {
    await page.locator('#mach0').click();
    await page.locator('#mach0').fill('2');
    await page.locator('#mach0').press('Enter');
    await page.locator('#message').filter({ hasText: 'no trim at mach0 = 2' }).waitFor();
    for (const id of ['message', 'mach0']) {
      const { y, height } = (await page.locator(`#${id}`).boundingBox())!;
      assert.ok(y >= 0 && y + height <= 800, `${id} is in view`);
    }
    await page.getByRole('button', { name: 'Step', exact: true }).click();
    const { names, rows } = table(await saved(page));
    assert.equal(Math.round(rows.at(-1)![names.indexOf('mach')]!), 8);
    assert.equal(rows.at(-1)![0], 0.002);
  }, { viewport: { width: 400, height: 800 } });
});

test('a link holds all settings', async () => {
  const link = '#configuration=2&aero=2&fuel_fraction=0.4&slosh_damping=0.02&step=0.005&speed=2&magnified=120&map=1&outputs=4097';
  await chromium.visit(page(link), async (page) => {
    await page.getByRole('button', { name: 'Copy link' }).click();
    assert.equal(new URL(page.url()).hash, link);
    for (const [id, value] of [['configuration', '2'], ['step', '0.005'], ['map', '1'], ['magnified', '120']] as const) {
      assert.equal(await page.locator(`#${id}`).inputValue(), value);
    }
    const shown = page.locator('.strip:visible .u-title');
    assert.deepEqual(await shown.allTextContents(), ['Angles, deg', 'Moment, N']);
    // What another link does not have is as at the start.
    await page.evaluate(() => void (location.hash = '#aero=2'));
    await shown.nth(7).waitFor();
    assert.equal(await page.locator('#configuration').inputValue(), '3');
    assert.equal(await page.locator('#map').inputValue(), '0');
  });
  await chromium.visit(page('#fuel_fraction=much&colour=1&manoeuvre=1.5&delta_e=1'), async (page) => {
    await page.locator('#message').filter({ hasText: 'fuel_fraction=much, colour=1, manoeuvre=1.5, delta_e=1' }).waitFor();
  });
});

test('a link holds controls, commands and releases, and flies with them', async () => {
  let link = '';
  await chromium.visit(page('#step=0.01'), async (page) => {
    await slide(page, 'delta_e', 0.13);
    await slide(page, 'phi', -0.3);
    await slide(page, 'map', 2);
    await page.locator('.choice summary').click();
    await page.getByRole('checkbox', { name: 'Flexible modes' }).click();
    await page.getByRole('button', { name: 'Copy link' }).click();
    link = new URL(page.url()).hash;
  });
  await chromium.visit(page(link), async (page) => {
    assert.equal(await page.locator('#delta_e').inputValue(), '0.13');
    assert.equal(await page.locator('#phi').inputValue(), '-0.3');
    assert.equal(await page.locator('#map').inputValue(), '2');
    assert.equal(await page.locator('.strip:visible').count(), 7);
    await page.keyboard.press('.');
    const { names, rows } = table(await saved(page));
    assert.equal(rows.at(-1)![names.indexOf('delta_e')], 0.13 / (180 / Math.PI));
    assert.equal(rows.at(-1)![names.indexOf('phi')], -0.3);
  });
  await chromium.visit(page('#manoeuvre=3&step=0.01'), async (page) => {
    await page.keyboard.press('.');
    assert.match((await page.locator('#command').textContent())!, /--set slosh1_offset=0\.05 --set slosh2_offset=0\.05/);
  });
  if (!autopilot) return;
  await chromium.visit(page('#autopilot=1&gamma_wanted=0.0087&V_change=-30'), async (page) => {
    assert.equal(await page.locator('#gamma_wanted').inputValue(), '0.5');
    assert.equal(await page.locator('#V_change').inputValue(), '-30');
  });
});

test('a strip tells the values under the pointer', async () => {
  await chromium.visit(page('#manoeuvre=1&step=0.01'), async (page) => {
    for (let step = 0; step < 100; step++) await page.keyboard.press('.');
    const strip = page.locator('.strip', { hasText: 'Elevator, deg' });
    await strip.scrollIntoViewIfNeeded();
    await strip.locator('.u-over').hover({ position: { x: 5, y: 40 } });
    const value = strip.locator('.u-value').last();
    await value.filter({ hasText: /^15\.53/ }).waitFor();
  });
});

test('a browser without WebAssembly shows pictures and says why', async () => {
  const without = (): void => void delete (globalThis as { WebAssembly?: unknown }).WebAssembly;
  await chromium.visit(page(''), async (page) => {
    await page.locator('#message').filter({ hasText: 'has no WebAssembly' }).waitFor();
    assert.ok(await page.locator('#pictures img').isVisible());
    assert.ok(await page.locator('#flight').isHidden());
  }, {}, without);
});

for (const colorScheme of ['light', 'dark'] as const) {
  for (const width of [400, 1280, 3840]) {
    test(`${width} px, ${colorScheme}: nothing is cut off, and axe-core finds nothing`, async () => {
      const options = { viewport: { width, height: Math.max(800, width / 2) }, colorScheme, reducedMotion: 'reduce' } as const;
      await chromium.visit(page(''), async (page) => {
        for (let step = 0; step < 30; step++) await page.keyboard.press('.');
        for (const details of await page.locator('details').all()) await details.locator('summary').first().click();
        assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
        assert.deepEqual(await accessible(page), []);
        await page.screenshot({ path: join(environment('AHV_PICTURES'), `${width}-${colorScheme}.png`), fullPage: true });
      }, options);
    });
  }
}

test('the autopilot climbs as asked', { skip: autopilot ? false : 'the page has no autopilot' }, async () => {
  await chromium.visit(page('#speed=10&step=0.01'), async (page) => {
    await page.keyboard.press('a');
    for (let press = 0; press < 4; press++) await page.keyboard.press('ArrowUp');
    assert.equal(await page.locator('#gamma_wanted').inputValue(), '1');
    for (let step = 0; step < 300; step++) await page.keyboard.press('.');
    const { names, rows } = table(await saved(page));
    assert.equal(rows.at(-1)![0], 3);
    assert.ok(rows.at(-1)![names.indexOf('gamma')]! > 0);
    assert.equal(await page.locator('#message').textContent(), '');
  });
});
