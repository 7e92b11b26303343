// A component as JavaScript and core modules that a browser can compile.

import { transpileBytes } from '@bytecodealliance/jco-transpile';
import { gzipSync } from 'node:zlib';

/** Its traces print nothing in a browser, but their arguments cost time at every call: without side effects they can go. */
const withoutTraces = (glue) => glue.replaceAll('_debugLog(', '/* @__PURE__ */ _debugLog(');

/** Glue code and compressed core modules of a component. */
export async function transpiled(bytes, name) {
  const { files } = await transpileBytes(bytes, {
    name,
    instantiation: 'sync',
    noTypescript: true,
    noNodejsCompat: true,
    base64Cutoff: 0,
  });
  const all = Object.entries(Array.isArray(files) ? Object.fromEntries(files) : files);
  const glue = all.find(([file]) => file.endsWith('.js'));
  const modules = all
    .filter(([file]) => file.endsWith('.wasm'))
    .map(([file, code]) => [file, gzipSync(code, { level: 9 }).toString('base64')]);
  return { glue: withoutTraces(Buffer.from(glue[1]).toString('utf8')), modules: Object.fromEntries(modules) };
}
