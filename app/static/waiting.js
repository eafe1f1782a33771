// Says what the visitor waits for, over the page, until it is there.
const LATE = 300; // ms: an answer that comes sooner needs no word
const LOOK = 100;

export class Waiting {
  constructor(model) {
    this.model = model;
    this.signs = new Map(); // by name: the sentence, and since when it is said
    this.root = Object.assign(document.createElement('div'), { className: 'waiting', hidden: true });
    this.root.setAttribute('role', 'status');
    model.on('waiting', () => this.say());
    this.say();
  }
  // An answer is on its way: said after a moment.
  soon(name, sentence) {
    this.signs.set(name, { sentence, since: performance.now() + LATE });
    this.say();
  }
  over(name) {
    if (this.signs.delete(name)) this.say();
  }
  // Said at once, until it is `there()` and `then()` is done with it, or is no longer `wanted()`.
  expect(name, sentence, there, wanted, then) {
    const sign = { sentence, since: 0 };
    this.signs.set(name, sign);
    const look = () => {
      if (this.signs.get(name) !== sign) return;
      const found = there();
      if (!found && wanted()) { setTimeout(look, LOOK); return; }
      this.over(name);
      if (found) then();
    };
    look();
    this.say();
  }
  // What could not be done is waited for no more.
  clear() {
    this.signs.clear();
    this.say();
  }
  say() {
    clearTimeout(this.saying);
    const now = performance.now(), all = [...this.signs.values()], due = all.filter((sign) => sign.since <= now);
    this.root.textContent = [due.at(-1)?.sentence, this.model.waiting].filter(Boolean).join(' ');
    this.root.hidden = !this.root.textContent;
    const later = all.filter((sign) => sign.since > now).map((sign) => sign.since);
    if (later.length) this.saying = setTimeout(() => this.say(), Math.min(...later) - now + 1);
  }
}
