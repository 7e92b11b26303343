import assert from 'node:assert/strict';
import { existsSync, readdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { after, test } from 'node:test';
import { Chromium, environment } from './browser';

const chromium = await Chromium.start();
after(() => chromium.close());
const site = dirname(environment('AHV_PAGE'));
const guides = readdirSync(join(site, 'guide'), { recursive: true, encoding: 'utf8' }).filter((file) => file.endsWith('.html'));

for (const colorScheme of ['light', 'dark'] as const) {
  test(`documents at 400 px, ${colorScheme}: nothing is cut off, and axe-core finds nothing`, async () => {
    assert.ok(guides.includes('README.html'));
    // The report on the paper is there if it has been made.
    const others = ['documentation/index.html', 'paper.html'].filter((page) => existsSync(join(site, page)));
    for (const page of [...others, ...guides.map((guide) => join('guide', guide))]) {
      const { width, faults } = await chromium.read(join(site, page), { viewport: { width: 400, height: 800 }, colorScheme });
      assert.equal(width, 400, page);
      assert.deepEqual(faults, [], page);
    }
  });
}
