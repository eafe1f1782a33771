// Open the session that came with the page, or say why it cannot be.
const FULL = 'The page could not be opened: the server is busy, or gone. Try again in a minute.';

const start = async () => {
  const { token } = JSON.parse(document.getElementById('session')?.textContent ?? '{}');
  const { Bokeh } = /** @type {any} */ (window);
  Bokeh.set_log_level('error');
  await Bokeh.embed.embed_items({}, [{ token, elementid: 'lab', roots: {}, root_ids: [], use_for_title: false }]);
  if (Bokeh.documents.length) return;
  const closed = Object.assign(document.createElement('p'), { className: 'closed', textContent: FULL });
  document.getElementById('lab')?.append(closed);
};

start();
