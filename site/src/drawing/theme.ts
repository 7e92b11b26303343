// Colours of the style sheet, for what is drawn on a canvas.

const NAMES = ['ink', 'muted', 'grid', 'panel', 'body', 'tank', 'liquid', 'shock', 'plume', 'elevator', 'pole', 'zero'] as const;

export type Theme = Record<(typeof NAMES)[number], string> & { lines: string[] };

export function theme(): Theme {
  const style = getComputedStyle(document.documentElement);
  const colour = (name: string): string => style.getPropertyValue(`--${name}`).trim();
  return {
    ...(Object.fromEntries(NAMES.map((name) => [name, colour(name)])) as Record<(typeof NAMES)[number], string>),
    lines: [1, 2, 3, 4].map((n) => colour(`line-${n}`)),
  };
}

/** Size of a text, px, as a part of that of the page, which grows with the screen. */
export function textSize(part: number): number {
  return Math.round(part * parseFloat(getComputedStyle(document.documentElement).fontSize));
}

/** Calls back when the colours change between light and dark. */
export function onThemeChange(changed: () => void): void {
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', changed);
}
