// Says when the connection to the server is lost, or about to be closed, and what that means.
const LOST = 'The connection to the server is lost. What is shown can still be played; nothing new is solved.';

export class Connection {
  constructor(model, page) {
    this.model = model;
    this.root = Object.assign(document.createElement('div'), { className: 'connection', hidden: true });
    this.root.setAttribute('role', 'alert');
    this.words = document.createElement('span');
    const reload = Object.assign(document.createElement('button'), { type: 'button', textContent: 'Reload' });
    reload.onclick = () => location.reload();
    this.root.append(this.words, reload);
    page.append(this.root);
    model.on('disconnected', () => this.say(model.disconnected));
    for (const shown of window.Bokeh?.documents ?? []) {
      shown.on_event('connection_lost', () => this.say(this.model.disconnected || LOST));
      shown.on_event('client_reconnected', () => this.say(''));
    }
  }
  say(sentence) {
    this.words.textContent = sentence;
    this.root.hidden = !sentence;
  }
}
