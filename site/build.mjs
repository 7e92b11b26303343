// Builds the pages, each of them one file that also works from a disk.
//
//   node build.mjs --fmu ahv=FOLDER [--fmu ahv_autopilot=FOLDER] [--root REPOSITORY] [--output FOLDER] [--flight FILE] [--report FILE] [--api FOLDER]
//
// index.html flies the vehicle, with the pages of the repository, the documentation of its FMU and, if given, the report on
// the paper and the API of the crate beside it. The page of a flight is a template, into which `cargo ahv fly` puts the data.

import { build } from 'esbuild';
import { cpSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { readArguments } from './build/arguments.mjs';
import { writeGuide } from './build/guide.mjs';
import { licenses, packages } from './build/licenses.mjs';
import { modules } from './build/modules.mjs';
import { linked, links } from './build/navigation.mjs';

/** The glue code between page and component is its work. */
const GENERATOR = '@bytecodealliance/jco-transpile';

const { fmus, root, output, flight, report, api } = readArguments();
const parts = { report, api };
const plugins = [modules({ fmus, root })];
const options = { bundle: true, minify: true, write: false, charset: 'utf8', legalComments: 'none', metafile: true, logLevel: 'warning' };
const script = (file) => build({ ...options, entryPoints: [file], format: 'iife', target: 'es2022', plugins });
const [fly, replay, style] = await Promise.all([
  script('src/main.ts'),
  script('src/replay/main.ts'),
  build({ ...options, entryPoints: ['src/style.css'] }),
]);

const source = (file) => readFileSync(join('src', file), 'utf8');
const text = ({ outputFiles }) => outputFiles.map((file) => file.text).join('\n').trim();
const picture = readFileSync(join(root, 'examples/elevator_doublet.png')).toString('base64');

function page(file, code) {
  const inserted = {
    style: `<style>${text(style)}</style>`,
    pictures: `<figure id="pictures"><img alt="Time history of an elevator doublet" src="data:image/png;base64,${picture}"></figure>`,
    links: links(parts),
    legend: source('legend.html').trim(),
    note: source('note.html').trim(),
    licenses: `<!--\n${packages([code.metafile, style.metafile]).join('\n').replaceAll('--', '- -')}-->`,
    // A closing tag would end the script.
    script: `<script>${text(code).replaceAll('</script', '<\\/script')}</script>`,
  };
  return source(file).replace(/<!--(\w+)-->/g, (_, name) => inserted[name]);
}

/** Copies a page, with links to the others. */
function copyPage(from, to, up) {
  writeFileSync(join(output, to), linked(readFileSync(from, 'utf8'), parts, up));
}

mkdirSync(output, { recursive: true });
for (const folder of ['documentation', 'terminalsAndIcons']) cpSync(join(fmus.ahv, folder), join(output, folder), { recursive: true });
copyPage(join(fmus.ahv, 'documentation/index.html'), 'documentation/index.html', '../');
if (report) copyPage(report, 'paper.html', '');
if (api) {
  cpSync(api, join(output, 'api'), { recursive: true });
  // Pages of rustdoc lead to a page above those of the crates.
  writeFileSync(join(output, 'api/index.html'), '<!doctype html><meta http-equiv="refresh" content="0; url=fmi_model/index.html"><a href="fmi_model/index.html">fmi_model</a>\n');
}
writeFileSync(join(output, 'index.html'), page('index.html', fly));
if (flight) writeFileSync(flight, page('replay.html', replay));
writeGuide(root, join(output, 'guide'), text(style), parts);
writeFileSync(join(output, 'licenses.txt'), licenses([fly, replay, style].map(({ metafile }) => metafile), GENERATOR, fmus));
