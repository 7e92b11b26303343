import assert from 'node:assert/strict';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { test } from 'node:test';
import { environment } from './browser';

/** Line numbers in the sources of a crate: the page makes these itself. */
const LINES = /^\d+(-\d+)?$/;

test('every link leads to a place in the site, and no page loads anything from elsewhere', () => {
  const site = dirname(environment('AHV_PAGE'));
  const pages = readdirSync(site, { recursive: true, encoding: 'utf8' }).filter((file) => file.endsWith('.html'));
  for (const page of ['index.html', 'documentation/index.html', 'guide/README.html', 'api/fmi_model/index.html']) assert.ok(pages.includes(join(page)), page);
  // Code and data have no links.
  const texts = new Map(pages.map((page) => [resolve(site, page), readFileSync(join(site, page), 'utf8').replace(/<(script|style)\b.*?<\/\1>/gs, '')]));
  const ids = new Map([...texts].map(([page, text]) => [page, new Set(Array.from(text.matchAll(/\sid="([^"]*)"/g), ([, id]) => id))]));
  for (const [page, text] of texts) {
    for (const [, attribute, link] of text.matchAll(/\s(href|src)="([^"]*)"/g)) {
      if (/^data:/.test(link!)) continue;
      if (/^[a-z]+:/.test(link!)) {
        assert.equal(attribute, 'href', `${page} loads ${link}`);
        continue;
      }
      const [path, anchor] = link!.split('#');
      const target = path ? resolve(dirname(page), path) : page;
      assert.ok(existsSync(target), `${page}: ${link}`);
      if (anchor && !LINES.test(anchor)) assert.ok([anchor, decodeURIComponent(anchor)].some((id) => ids.get(target)?.has(id)), `${page}: ${link} has no such place`);
    }
  }
});
