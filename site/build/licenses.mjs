// Licences of what is part of the page: packages, and the crates in the FMUs.

import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const LINE = `\n${'-'.repeat(80)}\n\n`;

/**
 * `metafiles` are esbuild's lists of what the bundles contain, `generator` is a package whose glue code is in
 * them too, `fmus` are folders of FMUs by name.
 */
export function licenses(metafiles, generator, fmus) {
  const glue = packageOf(dirname(fileURLToPath(import.meta.resolve(generator))));
  const crates = Object.values(fmus).map((folder) => join(folder, 'documentation/licenses')).flatMap(texts);
  return [...packages(metafiles, [glue]), ...new Set(crates)].join(LINE);
}

/** Of the packages in bundles, and in further folders. */
export function packages(metafiles, more = []) {
  const folders = new Set(more);
  for (const file of metafiles.flatMap(({ inputs }) => Object.keys(inputs))) {
    if (/(^|\/)node_modules\//.test(file)) folders.add(packageOf(dirname(resolve(file))));
  }
  const found = [...folders].map((folder) => {
    const { name, version, license } = manifest(folder);
    const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
    return `${name} ${version}: ${license}\n\n${file ? readFileSync(join(folder, file), 'utf8').trim() : ''}\n`;
  });
  return found.sort();
}

function texts(folder) {
  if (!existsSync(folder)) return [];
  return readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map(({ parentPath, name }) => join(parentPath, name))
    .sort()
    .map((file) => `${file.slice(folder.length + 1)}\n\n${readFileSync(file, 'utf8').trim()}\n`);
}

/** The folder of the package that a folder is in. */
function packageOf(folder) {
  return existsSync(join(folder, 'package.json')) && manifest(folder).name ? folder : packageOf(dirname(folder));
}

function manifest(folder) {
  return JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
}
