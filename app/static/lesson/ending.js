// Where the last step has no next one: the lesson that follows, and all there are.
import { make } from '../browser/dom.js';
import { carried } from '../browser/home.js';
import { text } from '../text/catalogue.js';
import { lessonAt } from '../frame/address.js';

/** @import { Lesson } from './lesson.js' */

/** @param {Lesson} lesson */
export function endingOf({ page, record }) {
  const { next, next_title: title } = record;
  const all = make('button', { type: 'button', className: 'lesson-end-act', textContent: text('lesson.all') });
  all.onclick = () => page.scenes.open();
  all.setAttribute('aria-haspopup', 'dialog');
  if (!next || (carried && !Object.hasOwn(carried.lessons, next))) {
    return [all];
  }
  const name = text('lesson.follows', { title: title || next });
  const link = make('a', { href: lessonAt(next), className: 'lesson-end-act', title: name, ariaLabel: name });
  link.append(
    make('span', { className: 'lesson-long', textContent: name }),
    make('span', { className: 'lesson-short', textContent: text('lesson.follows-short') }),
  );
  return [all, link];
}
