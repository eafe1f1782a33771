// The first minute: what is seen, in one sentence, and three things to try. It can be put away for good.
import { questionsOf } from '../compare/questions.js';
import { family, text } from '../text/catalogue.js';
import { make } from './dom.js';
import { keep, kept } from './store.js';

/** @import { Page } from '../page.js' */
/** @import { Frame } from '../messages.js' */

const SEEN = family('first.seen');
const TRIES = family('first.tries');

/**
 * What this impact shows.
 * @param {Frame} frame
 */
export function seenIn(frame) {
  if (frame.kind === 'mechanism') {
    if (frame.main.sudden) return SEEN['rigid-links'];
    const bends = frame.mechanism.links.some(({ flexible }) => flexible) && !frame.moving?.rigid;
    if (frame.moving) return bends ? SEEN.moving : SEEN['moving-rigid'];
    return SEEN.mechanism;
  }
  if (frame.kind !== 'axial') return SEEN[frame.kind];
  const shown = frame.rods.length ? 'waves' : frame.exact.sudden ? 'impulse' : 'force';
  if (frame.impactor.kind === 'pendulum') return text('first.seen.pendulum', { shown });
  if (!frame.rods.length && frame.target.rotation) return SEEN.turning;
  if (!frame.rods.length) return text('first.seen.compact', { shown });
  return frame.rods.length > 1 ? SEEN.rods : SEEN.rod;
}

/**
 * What could be tried with it, the most telling first.
 * @param {Frame} frame
 * @returns {[words: string, choice: string, value: number | string][]}
 */
export const triesOf = ({ opens }) => opens.trials.map(([say, choice, value]) => [TRIES[say], choice, value]);

export class First {
  kind = '';
  /** @type {ReturnType<typeof triesOf>} */ offered = [];

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
    const tries = triesOf(frame).slice(0, 3);
    const seen = seenIn(frame);
    const kind = [frame.chosen.scene, seen, ...tries.map(([words]) => words)].join();
    this.offered = tries;
    if (kind === this.kind) return; // what the buttons do changes with every solve, what they say does not
    this.kind = kind;
    this.seen.textContent = seen;
    this.compare.hidden = !questionsOf(frame).length;
    this.tries.replaceChildren(
      ...tries.map(([textContent], k) => {
        const act = make('button', { type: 'button', className: 'when', textContent });
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
