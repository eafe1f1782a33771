// Lines of a scene file, of a command or of Python, to be copied.
import { download, make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';

/**
 * Lines to be copied; those of a scene file to be saved, too.
 * @param {'command' | 'python' | 'scene'} name
 * @param {HTMLElement} said  what is said of it
 * @param {() => string} file  its name
 */
export function partOf(name, said, file) {
  const code = make('pre', { tabIndex: 0 });
  const copy = make('button', { type: 'button', className: 'when', textContent: text('code.copy') });
  copy.ariaLabel = text('code.copy-about', { name });
  copy.onclick = async () => {
    try {
      await navigator.clipboard.writeText(code.textContent ?? '');
      said.textContent = text('code.copied');
    } catch {
      said.textContent = text('code.not-copied');
    }
  };
  const head = make('header', {}, make('h3', { textContent: text('code.part', { name }) }), copy);
  if (name === 'scene') {
    const save = make('button', { type: 'button', className: 'when', textContent: text('code.save') });
    save.onclick = () => download(new Blob([code.textContent ?? ''], { type: 'application/toml' }), file());
    head.append(save);
  }
  return { name, code, root: make('section', { className: 'code-part' }, head, code) };
}
