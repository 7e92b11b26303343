// Bundles the tests that run in node, with the modules that the page gets.

import { build } from 'esbuild';
import { readArguments } from '../build/arguments.mjs';
import { modules } from '../build/modules.mjs';

const { fmus, root, output } = readArguments();
await build({
  entryPoints: ['documents', 'engine', 'flight', 'links', 'page', 'pilot', 'roots', 'shock', 'thinned'].map((name) => `test/${name}.test.ts`),
  outdir: output,
  outExtension: { '.js': '.mjs' },
  bundle: true,
  platform: 'node',
  format: 'esm',
  external: ['playwright-core'],
  plugins: [modules({ fmus, root })],
});
