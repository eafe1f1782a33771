// A widget of MyST, by the interface of anywidget: the laboratory in a frame that is as high as it needs to be. MyST
// copies this module away from its folder: an address says where that is.

const FORM = 1; // of what a frame says: as in frame/framed.js
const SCHEMES = ['https:', 'http:', 'file:'];
const [FIRST, MOST] = [720, 4000]; // pixels of height: before it says one, and at most

/**
 * @param {object} given
 * @param {{ get: (name: 'src' | 'title') => any }} given.model  `src`: an address of the laboratory, as a link has it
 * @param {HTMLElement} given.el
 */
function render({ model, el }) {
  const src = model.get('src');
  const address =
    typeof src === 'string' && src && URL.canParse(src, document.baseURI) && new URL(src, document.baseURI);
  if (!address || !SCHEMES.includes(address.protocol))
    // a script in place of one would run in the book
    throw new Error(`src: got ${JSON.stringify(src)}; allowed: an address of the laboratory, such as Copy link gives`);
  address.search = `?embed&${address.search.slice(1)}`;
  const frame = document.createElement('iframe');
  Object.assign(frame, { src: address.href, title: model.get('title') ?? '', allow: 'clipboard-write' });
  Object.assign(frame.style, { display: 'block', width: '100%', height: `${FIRST}px`, border: '0' });
  const follow = (/** @type {MessageEvent} */ { data, source }) => {
    if (source !== frame.contentWindow || data?.strikewave !== FORM || !(data.height > 0)) return;
    frame.style.height = `${Math.min(data.height, MOST)}px`;
  };
  window.addEventListener('message', follow);
  el.append(frame);
  return () => {
    window.removeEventListener('message', follow);
    frame.remove();
  };
}

export default { render };
