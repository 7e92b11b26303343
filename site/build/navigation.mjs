// Links between the pages of the site.

/** Pages by their addresses; those of the report and of the crate only where they are part of the site. */
function pages({ report, api }) {
  return [
    ['index.html', 'The vehicle in flight'],
    ['guide/README.html', 'Getting started'],
    ['documentation/index.html#signs', 'Signs'],
    ['documentation/index.html#equations', 'Equations'],
    ['documentation/index.html#validity', 'Validity'],
    ['documentation/index.html#variables', 'Variables'],
    ...(report ? [['paper.html', 'The paper, cell by cell']] : []),
    ['guide/crates/fmi/README.html', 'FMUs in Rust'],
    ...(api ? [['api/fmi_model/index.html', 'API of fmi-model']] : []),
    ['documentation/index.html#cite', 'How to cite'],
  ];
}

/** The links, for a page in a folder from which `up` leads to that of the site. */
export function links(parts, up = '') {
  return pages(parts)
    .map(([address, text]) => `<a href="${up}${address}">${text}</a>`)
    .join(' ');
}

/** A page that is made elsewhere, with the links at its top. */
export function linked(html, parts, up) {
  const style = 'display:flex;flex-wrap:wrap;gap:.3rem 1rem;padding:.8rem 0;font-size:.94rem';
  return html.replace(/<body[^>]*>/, (body) => `${body}\n<nav aria-label="Site" style="${style}">${links(parts, up)}</nav>`);
}
