// The page in Debian's Chromium.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { chromium, type Browser, type BrowserContextOptions, type Page } from 'playwright-core';

export const environment = (name: string): string => process.env[name] ?? assert.fail(`${name} is not set`);

export class Chromium {
  private constructor(private readonly browser: Browser) {}

  static async start(): Promise<Chromium> {
    return new Chromium(await chromium.launch({ executablePath: environment('AHV_CHROMIUM'), args: ['--no-sandbox'] }));
  }

  /**
   * Runs a test on the page as a local file, after `first` in the page; it fails if the page reports an error or asks
   * for another file.
   */
  async visit(file: string, visitor: (page: Page) => Promise<void>, options: BrowserContextOptions = {}, first?: () => void): Promise<void> {
    const context = await this.browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
    try {
      if (first) await context.addInitScript(first);
      const page = await context.newPage();
      const [errors, requests] = [new Array<string>(), new Array<string>()];
      page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
      page.on('pageerror', (error) => errors.push(error.message));
      page.on('request', (request) => /^(data|blob):/.test(request.url()) || requests.push(request.url()));
      await page.goto(`file://${file}`);
      await page.locator('#flight, #message:not(:empty)').first().waitFor();
      await visitor(page);
      assert.deepEqual(errors, []);
      assert.equal(requests.length, 1, requests.join(' '));
    } finally {
      await context.close();
    }
  }

  /** A page of the documentation: its width in a window of a width, and what axe-core finds fault with. */
  async read(file: string, options: BrowserContextOptions & { viewport: { width: number; height: number } }): Promise<{ width: number; faults: string[] }> {
    const context = await this.browser.newContext(options);
    try {
      const page = await context.newPage();
      await page.goto(`file://${file}`);
      return { width: await page.evaluate(() => document.documentElement.scrollWidth), faults: await accessible(page) };
    } finally {
      await context.close();
    }
  }

  async close(): Promise<void> {
    await this.browser.close();
  }
}

export interface Table {
  names: string[];
  rows: number[][];
}

export function table(csv: string): Table {
  const [head, ...rows] = csv.trim().split('\n').map((line) => line.split(','));
  return { names: head!, rows: rows.map((row) => row.map(Number)) };
}

/** The CSV that the page saves. */
export async function saved(page: Page): Promise<string> {
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save CSV' }).click();
  return readFileSync(await (await download).path(), 'utf8');
}

interface Axe {
  run(): Promise<{ violations: { id: string; nodes: { html: string; failureSummary?: string }[] }[] }>;
}

/** What axe-core finds fault with. */
export async function accessible(page: Page): Promise<string[]> {
  await page.addScriptTag({ path: createRequire(environment('AHV_PACKAGES')).resolve('axe-core') });
  return page.evaluate(async () => {
    const { violations } = await (globalThis as unknown as { axe: Axe }).axe.run();
    return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html, failureSummary }) => `${html} ${failureSummary}`).join('\n')}`);
  });
}

/** Moves a slider as a pointer does, or selects from a list. */
export async function slide(page: Page, id: string, value: number): Promise<void> {
  const control = page.locator(`#${id}`);
  if (await control.evaluate((element) => element instanceof HTMLSelectElement)) await control.selectOption(String(value));
  else await control.fill(String(value));
}
