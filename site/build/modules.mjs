// Modules of the page that are made from FMUs and data files: `virtual:...`.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { parse } from 'smol-toml';
import { transpiled } from './component.mjs';
import { described } from './variables.mjs';

const PREFIX = 'virtual:';
const GLUE = 'glue:';
/** Examples that the page flies, in the order of their numbers. */
const MANOEUVRES = ['elevator_doublet', 'throttle_step'];

/** An esbuild plugin. `fmus` are unpacked FMUs of FMI 3.0 by name, `root` is the repository. */
export function modules({ fmus, root }) {
  const glue = new Map();
  const fmu = async (name) => {
    const folder = fmus[name];
    if (!folder) return 'export default undefined;';
    const component = await transpiled(readFileSync(join(folder, `binaries/wasm32-wasip2/${name}.wasm`)), name);
    const { token, variables, derivatives } = described(readFileSync(join(folder, 'modelDescription.xml'), 'utf8'));
    glue.set(name, component.glue);
    const rest = JSON.stringify({ name, token, variables, derivatives, modules: component.modules });
    return `import { instantiate } from '${GLUE}${name}';\nexport default { instantiate, ...${rest} };`;
  };
  const text = (file) => readFileSync(join(root, file), 'utf8');
  const sources = {
    ahv: () => fmu('ahv'),
    ahv_autopilot: () => fmu('ahv_autopilot'),
    vehicle: () => `export default ${JSON.stringify(values(parse(text('src/data/vehicle.toml'))))};`,
    manoeuvres: () => `export default ${JSON.stringify(MANOEUVRES.map((name) => text(`examples/${name}.csv`)))};`,
    published: () => `export default ${JSON.stringify(parse(text('src/data/published.toml')))};`,
  };
  return {
    name: 'modules',
    setup(build) {
      build.onResolve({ filter: /^virtual:/ }, ({ path }) => ({ path: path.slice(PREFIX.length), namespace: 'virtual' }));
      build.onLoad({ filter: /.*/, namespace: 'virtual' }, async ({ path }) => ({ contents: await sources[path]() }));
      build.onResolve({ filter: /^glue:/ }, ({ path }) => ({ path: path.slice(GLUE.length), namespace: 'glue' }));
      build.onLoad({ filter: /.*/, namespace: 'glue' }, ({ path }) => ({ contents: glue.get(path) }));
    },
  };
}

/** Quantities `{ value, unit, ... }` as their values. */
function values(node) {
  if (Array.isArray(node)) return node.map(values);
  if (node === null || typeof node !== 'object') return node;
  if ('value' in node && 'unit' in node) return node.value;
  return Object.fromEntries(Object.entries(node).map(([key, inner]) => [key, values(inner)]));
}
