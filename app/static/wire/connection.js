// The connection to the server. When it is lost that is said at once, and whether what is chosen waits for it; what is
// shown plays on, and when a server answers again the page comes back with all that it showed: the address holds the
// choices, the browser the rest.
import { text } from '../text/catalogue.js';
import { documents } from '../browser/bokeh.js';
import { make } from '../browser/dom.js';
import { alone, carried, served } from '../browser/home.js';
import { keep, kept } from '../browser/store.js';

/** @import { Page } from '../page.js' */

const LATE = 800; // ms without an answer after which the server is asked whether it is there
const PATIENCE = 1000; // ms that it has to say so
const TICK = 300; // ms between looks at the clock
const REGULAR = 20_000; // ms between questions while all is well
const AGAIN = 1000; // ms between them while it is not, at first
const SELDOM = 8000; // and later
const NAME = 'resume'; // under which the state is kept from one page to the next
const FRESH = 120_000; // ms for which it is gone on with

export class Connection {
  lost = false;
  cut = false; // the socket is closed: the session is not come back to
  closed = false; // by the server, with a reason: who was turned out does not come back by itself
  /** @type {number | undefined} */ timer;
  /** @type {number | undefined} */ watch;
  offline = () => this.#lose();
  asked = performance.now(); // when the server was asked last

  /**
   * @param {Page} page
   * @param {() => unknown} state  to come back with
   */
  constructor(page, state) {
    const { model } = page;
    this.page = page;
    this.model = model;
    this.state = state;
    this.pause = AGAIN;
    this.root = make('div', { className: 'connection', role: 'alert', hidden: true });
    this.words = make('span');
    const onclick = () => this.#return();
    const reload = make('button', { type: 'button', textContent: text('connection.reload'), onclick });
    this.root.append(this.words, reload);
    page.root.append(this.root);
    if (carried) return; // nothing that could be lost
    model.on('disconnected', () => this.#turnedOut());
    for (const shown of documents()) {
      shown.on_event('connection_lost', () => this.#lose(true));
      if (!alone) shown.on_event('client_reconnected', () => this.#found());
    }
    window.addEventListener('offline', this.offline);
    this.watch = window.setInterval(() => this.#watch(), TICK);
  }
  leave() {
    clearInterval(this.watch);
    clearTimeout(this.timer);
    window.removeEventListener('offline', this.offline);
  }
  #turnedOut() {
    if (!this.model.disconnected) return;
    this.closed = true;
    this.#say(text(this.model.disconnected));
  }
  /** A server that hangs, or a line that is cut, closes no socket: it is asked when an answer is late, and at times. */
  async #watch() {
    const now = performance.now();
    if (this.lost || this.closed || document.hidden) return;
    const due = this.page.changes.late > LATE && now - this.asked > LATE;
    if (!due && now - this.asked < REGULAR) return;
    this.asked = now;
    if (!(await answers(served('liveness')))) this.#lose();
  }
  /** @param {boolean} [cut] */
  #lose(cut = false) {
    this.cut ||= cut;
    if (this.lost || this.closed) return;
    this.lost = true;
    this.pause = AGAIN;
    this.page.waiter.clear(); // what it was for is said here
    this.tell();
    if (alone || !cut) this.#look(); // when another's page comes back is its own affair
  }
  /** What goes on without a server, and what does not. */
  tell() {
    if (!this.lost || this.closed) return;
    this.#say(text(this.model.disconnected || (this.page.own.behind ? 'connection.waits' : 'connection.lost')));
  }
  /** Ask until there is a server with room; then go on there. */
  #look() {
    clearTimeout(this.timer);
    const pause = this.pause * (0.7 + 0.6 * Math.random()); // not all pages at the same moment
    this.timer = window.setTimeout(() => this.#ask(), pause);
  }
  async #ask() {
    this.pause = Math.min(1.4 * this.pause, SELDOM);
    if (this.closed) return;
    if (!(await answers(served('liveness')))) this.#look();
    else if (!this.cut) this.#found();
    else if (await answers(window.location)) {
      this.#say(text('connection.back'));
      this.#return();
    } else this.#look();
  }
  /** It was only slow, or the line was: the session is still there. */
  #found() {
    this.lost = this.cut = false;
    this.#say('');
    this.page.changes.flush();
  }
  #return() {
    this.keep();
    window.location.reload();
  }
  /** What is shown, for when this page is come back to. */
  keep() {
    if (alone) keep(NAME, { ...Object(this.state()), at: Date.now() }, true);
  }
  /** @param {string} sentence */
  #say(sentence) {
    if (this.words.textContent === sentence) return; // which is read out whenever it is set
    this.words.textContent = sentence;
    this.root.hidden = !sentence;
    this.root.parentElement?.classList.toggle('lost', Boolean(sentence));
  }
}

/**
 * The state with which the page has come back, once.
 * @returns {Record<string, any> | null}
 */
export function cameBack() {
  if (!alone) return null;
  const state = kept(NAME, /** @type {Record<string, any> | null} */ (null), true);
  keep(NAME, undefined, true);
  const [how] = performance.getEntriesByType('navigation');
  const again = 'type' in how && how.type !== 'navigate'; // the same page, not another visit
  return state && again && Date.now() - state.at < FRESH ? state : null;
}

/**
 * Whether an address is answered soon, and well.
 * @param {URL | Location} address
 */
async function answers(address) {
  try {
    const signal = AbortSignal.timeout(PATIENCE);
    return (await fetch(address.href, { signal, cache: 'no-store' })).ok;
  } catch {
    return false;
  }
}
