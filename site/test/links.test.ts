import assert from 'node:assert/strict';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { test } from 'node:test';
import { environment } from './browser';

test('every link leads to a file of the site, and no page loads anything from elsewhere', () => {
  const site = dirname(environment('AHV_PAGE'));
  const pages = readdirSync(site, { recursive: true, encoding: 'utf8' }).filter((file) => file.endsWith('.html'));
  assert.ok(pages.includes('index.html') && pages.includes(join('documentation', 'index.html')));
  for (const page of pages) {
    // Code and data have no links.
    const text = readFileSync(join(site, page), 'utf8').replace(/<(script|style)\b.*?<\/\1>/gs, '');
    for (const [, attribute, link] of text.matchAll(/\s(href|src)="([^"]*)"/g)) {
      if (/^(#|data:)/.test(link!)) continue;
      if (/^[a-z]+:/.test(link!)) assert.equal(attribute, 'href', `${page} loads ${link}`);
      else assert.ok(existsSync(resolve(site, dirname(page), link!.split('#')[0]!)), `${page}: ${link}`);
    }
  }
});
