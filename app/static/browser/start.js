// Open the session that came with the page, or say why it cannot be.
const start = async () => {
  const { token } = JSON.parse(document.getElementById('session')?.textContent ?? '{}');
  const { Bokeh, strikewaveTexts } = /** @type {any} */ (window);
  Bokeh.set_log_level('error');
  await Bokeh.embed.embed_items({}, [{ token, elementid: 'lab', roots: {}, root_ids: [], use_for_title: false }]);
  if (Bokeh.documents.length) return;
  const closed = document.createElement('p');
  Object.assign(closed, { className: 'closed', textContent: strikewaveTexts.texts['connection.closed'] });
  document.getElementById('lab')?.append(closed);
};

start();
