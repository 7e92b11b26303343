// Keys for what the page can do; those that an element with the focus needs stay with it.

export function onKeys(keys: Record<string, () => void>, arrow: (key: string) => boolean): void {
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { target, key } = event;
    const field = target instanceof HTMLElement && target.matches('input, select, button, summary, a');
    // A slider, list or button with the focus keeps the keys that it uses.
    if (field && ['ArrowUp', 'ArrowDown', 'ArrowLeft', 'ArrowRight', ' ', 'Enter'].includes(key)) return;
    if (target instanceof HTMLElement && target.matches('input[type=number], select')) return;
    const action = keys[key.toLowerCase()];
    if (action) action();
    else if (!arrow(key)) return;
    event.preventDefault();
  });
}
