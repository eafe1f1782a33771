// The first minute: what is seen, in one sentence, and three things to try. It can be put away for good.
import { questionsOf } from '../compare/questions.js';
import { family, text } from '../text/catalogue.js';
import { make } from './dom.js';
import { keep, kept } from './store.js';

/** @import { Page } from '../page.js' */
/** @import { Frame, Try } from '../messages.js' */

const TRIES = family('first.tries');

export class First {
  kind = '';
  /** @type {Try[]} */ offered = [];

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    this.seen = make('p');
    this.tries = make('ul');
    const hide = make('button', { type: 'button', className: 'sign', textContent: '✕' });
    hide.title = hide.ariaLabel = text('first.hide');
    hide.onclick = () => {
      this.root.hidden = true;
      keep('first', false);
    };
    const head = make('header', { className: 'panel-head' }, make('h2', { textContent: text('first.title') }), hide);
    this.root = make('section', { className: 'first', hidden: !kept('first', true) });
    this.compare = make('button', { type: 'button', className: 'when', textContent: text('first.compare') });
    this.compare.onclick = () => page.compare.bar.open();
    const questions = make('p', {}, this.compare);
    this.root.append(head, this.seen, make('h3', { textContent: text('first.try') }), this.tries, questions);
  }
  /** @param {Frame} frame */
  load(frame) {
    if (this.root.hidden) return;
    const tries = frame.opens.trials.slice(0, 3);
    const seen = this.page.view.story.seen(frame);
    const kind = [frame.chosen.scene, seen, ...tries.map(([say]) => say)].join();
    this.offered = tries;
    if (kind === this.kind) return; // what the buttons do changes with every solve, what they say does not
    this.kind = kind;
    this.seen.textContent = seen;
    this.compare.hidden = !questionsOf(frame).length;
    this.tries.replaceChildren(
      ...tries.map(([say], k) => {
        const act = make('button', { type: 'button', className: 'when', textContent: TRIES[say] });
        act.onclick = () => this.#try(k);
        return make('li', {}, act);
      }),
    );
  }
  /** @param {number} k */
  #try(k) {
    const [, name, value] = this.offered[k] ?? [];
    if (name !== undefined && value !== undefined) this.page.choose(name, value);
  }
}
