// The repository's pages in Markdown as pages of the site: those below, and all that they lead to.

import { Marked } from 'marked';
import { gfmHeadingId } from 'marked-gfm-heading-id';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join, posix } from 'node:path';
import { links } from './navigation.mjs';

const FIRST = ['README.md', 'crates/fmi/README.md'];

/** Writes the pages and their images below `output`; `style` is that of the site, `parts` are its optional pages. */
export function writeGuide(root, output, style, parts) {
  const pages = new Map();
  const images = new Set();
  const waiting = [...FIRST];
  for (let file = waiting.pop(); file; file = waiting.pop()) {
    if (pages.has(file)) continue;
    const { html, title, leads } = rendered(root, file, images);
    pages.set(file, { html, title });
    waiting.push(...leads);
  }
  for (const [file, { html, title }] of pages) {
    const up = '../'.repeat(file.split('/').length);
    write(join(output, asPage(file)), framed(html, title, links(parts, up), style));
  }
  for (const file of images) write(join(output, file), readFileSync(join(root, file)));
}

/** A page as HTML, with the files in Markdown that it leads to. */
function rendered(root, file, images) {
  const leads = [];
  let title = '';
  const marked = new Marked(gfmHeadingId());
  marked.use({
    walkTokens(token) {
      if (token.type === 'heading' && token.depth === 1) title ||= token.text.replaceAll('`', '');
      if (token.type === 'image' && local(token.href)) images.add(beside(file, token.href));
    },
    renderer: {
      link({ href, tokens }) {
        const text = this.parser.parseInline(tokens);
        if (href.startsWith('#') || !local(href)) return `<a href="${href}">${text}</a>`;
        const [path, anchor] = href.split('#');
        const target = folderPage(root, beside(file, path));
        // Sources and data are in the repository only.
        if (!target.endsWith('.md')) return text;
        leads.push(target);
        const page = posix.relative(posix.dirname(file), asPage(target));
        return `<a href="${page}${anchor ? `#${anchor}` : ''}">${text}</a>`;
      },
    },
  });
  const html = marked.parse(readFileSync(join(root, file), 'utf8'));
  // What scrolls can be reached with the keyboard; a corner of a table is no heading.
  return { html: html.replaceAll('<pre>', '<pre tabindex="0">').replace(/<th( [^>]*)?><\/th>/g, '<td></td>'), title, leads };
}

const local = (href) => !/^[a-z]+:/.test(href);
const beside = (file, href) => posix.normalize(posix.join(posix.dirname(file), href));
const asPage = (file) => file.replace(/\.md$/, '.html');

/** The page that a link to a folder leads to. */
function folderPage(root, path) {
  const page = posix.join(path, 'README.md');
  return existsSync(join(root, page)) ? page : path;
}

function framed(html, title, navigation, style) {
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>${title.replaceAll('<', '&lt;')}</title>
<style>${style}</style>
</head>
<body class="guide">
<header><nav aria-label="Site">${navigation}</nav></header>
<main>
${html}</main>
</body>
</html>
`;
}

function write(file, content) {
  mkdirSync(dirname(file), { recursive: true });
  writeFileSync(file, content);
}
