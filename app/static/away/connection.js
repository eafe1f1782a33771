// The connection to the server. That it is lost is said once something waits for it: what is shown plays on, and the
// browser answers what it can. When a server answers again the page comes back with all that it showed: the address
// holds the choices, the browser the rest.
import { text } from '../text/catalogue.js';
import { documents } from '../browser/bokeh.js';
import { make } from '../browser/dom.js';
import { alone, served } from '../browser/home.js';
import { keepState } from '../frame/state.js';

/** @import { Frame } from '../messages.js' */
/** @import { Page } from '../page.js' */

const LATE = 800; // ms without an answer after which the server is asked whether it is there
const PATIENCE = 1000; // ms that it has to say so
const TICK = 300; // ms between looks at the clock
const REGULAR = 20_000; // ms between questions while all is well
const AGAIN = 1000; // ms between them while it is not, at first
const SELDOM = 8000; // and later
const SAID = 10_000; // ms for which it is said that something cannot be had
const PARTS = /** @type {const} */ (['story', 'bodies']); // of which the browser knows less than the server

export class Connection {
  lost = false;
  cut = false; // the socket is closed: the session is not come back to
  closed = false; // by the server, with a reason: who was turned out does not come back by itself
  /** @type {number | undefined} */ timer;
  /** @type {number | undefined} */ watch;
  offline = () => this.#lose();
  asked = performance.now(); // when the server was asked last
  missed = { what: '', until: 0 }; // what was asked for and cannot be had
  /** @type {Frame | null} */ filled = null; // that analyses have heard of

  /** @param {Page} page */
  constructor(page) {
    const { model } = page;
    this.page = page;
    this.model = model;
    this.pause = AGAIN;
    this.root = make('div', { className: 'connection', role: 'alert', hidden: true });
    this.words = make('span');
    const onclick = () => this.#return();
    this.reload = make('button', { type: 'button', textContent: text('connection.reload'), onclick });
    this.root.append(this.words, this.reload);
    this.quiet = make('div', { className: 'away', role: 'status' });
    page.root.append(this.root, this.quiet);
    this.lacks = PARTS.map((part) => make('p', { className: 'help', textContent: text('connection.lacks', { part }) }));
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
    this.tell();
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
  /** What waits for the server while there is none; of the rest no more than a line. */
  tell() {
    const { analyses, changes, frame, own } = this.page;
    if (!this.lost || this.closed || own.due) return; // whether it can be answered here is not known yet
    const made = own.made.has(frame);
    if (made && !changes.resting && this.filled !== frame) analyses.take(frame);
    this.filled = frame;
    this.#mark(made);
    const what = this.#awaited;
    const sentence = own.answers ? what && text('connection.waits', { what }) : text('connection.lost');
    this.#say(this.model.disconnected ? text(this.model.disconnected) : sentence, text('connection.quiet'));
  }
  /** What waits for the server, by its name in the texts, or nothing. */
  get #awaited() {
    const { analyses, bodies, changes, compare, frame, model, own } = this.page;
    const { goal, waiting } = changes;
    const scene = goal?.scene ?? waiting.scene ?? model.scene;
    if (goal || own.behind) return scene === frame.chosen.scene ? 'choice' : 'scene';
    if (bodies.unanswered.length) return 'body';
    if (compare.due) return 'kept';
    const seen = analyses.all.filter(({ open, root }) => open && root.getClientRects().length);
    const running = model.stability_running || model.tradeoff_running;
    if (seen.some(({ root }) => running || root.ariaBusy === 'true')) return 'analysis';
    return performance.now() < this.missed.until ? this.missed.what : '';
  }
  /**
   * Beside an answer of the browser's own, what it lacks.
   * @param {boolean} made  whether that is shown
   */
  #mark(made) {
    const { bodies, root } = this.page;
    root.classList.toggle('unserved', made);
    if (!made) {
      for (const each of this.lacks) each.remove();
      return;
    }
    const { warnings } = /** @type {{ warnings?: { list: HTMLElement } }} */ (this.page.story); // not of all kinds
    for (const [k, place] of [warnings?.list, bodies.list].entries())
      if (place?.nextSibling !== this.lacks[k]) place?.after(this.lacks[k]);
  }
  /**
   * What was asked for cannot be had.
   * @param {'gallery' | 'files'} what
   * @returns {boolean}  whether that is said here, as there is no server
   */
  miss(what) {
    if (this.lost) this.missed = { what, until: performance.now() + SAID };
    this.tell();
    return this.lost;
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
    else if (document.querySelector(':active')) {
      this.pause = AGAIN; // not while a hand drags
      this.#look();
    } else if (await answers(window.location)) {
      if (!this.root.hidden) this.#say(text('connection.back'));
      this.#return();
    } else this.#look();
  }
  /** It was only slow, or the line was: the session is still there. */
  #found() {
    this.lost = this.cut = false;
    this.missed.until = 0;
    this.#mark(false);
    this.#say('');
    this.page.changes.flush();
  }
  #return() {
    keepState(this.page);
    window.location.reload();
  }
  /**
   * @param {string} sentence
   * @param {string} [quiet]  what is said where that is nothing, in small letters
   */
  #say(sentence, quiet = '') {
    const line = sentence ? '' : quiet;
    if (this.quiet.textContent !== line) this.quiet.textContent = line;
    this.root.parentElement?.classList.toggle('adrift', Boolean(line));
    if (this.words.textContent === sentence) return; // which is read out whenever it is set
    this.words.textContent = sentence;
    this.root.hidden = !sentence;
    this.reload.hidden = alone && !this.closed; // it comes back by itself, and till then would be gone
    this.root.parentElement?.classList.toggle('lost', Boolean(sentence));
  }
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
