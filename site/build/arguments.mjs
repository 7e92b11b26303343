// Command line of build.mjs and of the tests.

import { parseArgs } from 'node:util';

/**
 * `--fmu NAME=FOLDER` (an unpacked FMU of FMI 3.0, repeatable), `--root REPOSITORY`, `--output FOLDER`, `--flight FILE`,
 * `--report FILE`, `--api FOLDER`.
 */
export function readArguments() {
  const { values } = parseArgs({
    options: {
      fmu: { type: 'string', multiple: true, default: [] },
      root: { type: 'string', default: '..' },
      flight: { type: 'string' },
      report: { type: 'string' },
      api: { type: 'string' },
      output: { type: 'string', default: '../target/site' },
    },
  });
  const fmus = Object.fromEntries(values.fmu.map((text) => text.split(/=(.*)/s).slice(0, 2)));
  return { fmus, root: values.root, output: values.output, flight: values.flight, report: values.report, api: values.api };
}
