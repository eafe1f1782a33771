// What the stories of all kinds of impacts are made of: events, warnings, where the energy went.
import { text } from '../text/catalogue.js';
import { aboutOf, changesOf } from '../form/settings.js';
import { columnHead, make, scrolled } from '../browser/dom.js';

/** @import { Frame } from '../messages.js' */

/** @typedef {[t: number, sentence: string, name?: string]} Event  the name in a few words */

/** @param {string} [textContent] */
export const heading = (textContent = '') => make('h2', { textContent });

/**
 * A table below its heading.
 * @param {string} title
 * @param {HTMLElement} table
 */
export const headed = (title, table) => [heading(title), scrolled(table, title)];

/** Events in the order of time; the latest is marked while the clock runs. */
export class Events {
  root = make('ol', { className: 'events' });
  /** @type {Event[]} */ events = [];
  /** @type {HTMLElement[]} */ items = [];
  latest = -1;

  /**
   * @param {(t: number) => void} go  set the clock
   * @param {(t: number) => string} written
   * @param {number} early  how long before an event it is marked
   */
  constructor(go, written, early) {
    this.go = go;
    this.written = written;
    this.early = early;
  }
  /**
   * @param {Event[]} events
   * @param {number} [most]  of many only the first and the last are listed
   */
  load(events, most = Infinity) {
    this.events = events.length > most ? [...events.slice(0, most - 1), events[events.length - 1]] : events;
    this.latest = -1;
    this.items = this.events.map(([t, sentence]) => {
      const time = make('button', { type: 'button', className: 'when', textContent: this.written(t) });
      time.onclick = () => this.go(t);
      return make('li', {}, time, make('span', { textContent: sentence }));
    });
    this.root.replaceChildren(...this.items);
  }
  /** What is said of the instant shown. */
  get caption() {
    return this.events[Math.max(this.latest, 0)]?.[1] ?? '';
  }
  /** @param {number} t */
  at(t) {
    const latest = this.events.findLastIndex(([when]) => when <= t + this.early);
    if (latest === this.latest) return;
    this.latest = latest;
    this.items.forEach((item, k) => item.toggleAttribute('aria-current', k === latest));
  }
}

/** Warnings and remarks. */
export class Warnings {
  heading = heading(text('story.warnings'));
  list = make('ul', { className: 'warnings' });

  /** @param {string[]} notes */
  load(notes) {
    this.list.replaceChildren(...notes.map((textContent) => make('li', { textContent })));
    this.list.hidden = this.heading.hidden = !notes.length;
  }
}

/**
 * Head of a table of contacts, and the units below it.
 * @param {string[]} units
 */
export function contactHead(units) {
  const titles = ['', ...['from', 'to', 'impulse', 'peak'].map((name) => text(`story.${name}`))].map(columnHead);
  const row = make('tr', { className: 'units' }, ...units.map((textContent) => make('td', { textContent })));
  return make('thead', {}, make('tr', {}, ...titles), row);
}

/**
 * A button that looks closer at a contact.
 * @param {string} textContent
 * @param {() => void} onclick
 * @param {string} [kind]
 */
export const lookCloser = (textContent, onclick, kind = '') =>
  make('button', {
    type: 'button',
    className: `when ${kind}`.trim(),
    title: text('story.look-closer'),
    textContent,
    onclick,
  });

/**
 * What a scene says of itself and where it is from; of a changed one, in what it is another. And which of its keys have
 * no control here.
 * @param {Frame} frame
 * @param {string} source  a sentence
 */
export function noteOf(frame, source) {
  const { note, unshown } = frame;
  const what = changesOf(frame);
  const own = what ? [text('story.changed', { title: aboutOf(frame.title), what })] : [source, note];
  const keys = unshown.length ? text('story.unshown', { keys: unshown.join(', ') }) : '';
  return [...own, keys].filter(Boolean).join(' ');
}
