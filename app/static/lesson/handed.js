// At the end of a lesson: the code of all answers, which a student may give to a teacher. Nothing of it is sent.
import { make } from '../browser/dom.js';
import { carried, framed } from '../browser/home.js';
import { text } from '../text/catalogue.js';
import { mainButton } from './answered.js';
import { codeOf, SALTS, givenOf } from './code.js';

/** @import { Lesson } from './lesson.js' */

/**
 * @param {string} textContent
 * @param {string} words  that it copies
 * @param {(sentence: string) => void} say
 */
export function copyButton(textContent, words, say) {
  const button = make('button', { type: 'button', className: 'whole', textContent });
  button.onclick = async () => {
    try {
      await navigator.clipboard.writeText(words);
      button.textContent = text('class.copied');
    } catch {
      button.textContent = text('class.by-hand', { words }); // where a browser forbids it
    }
    say(button.textContent);
  };
  return button;
}

/** @param {Lesson} lesson */
function shown(lesson) {
  const { progress, record } = lesson;
  progress.salt ??= Math.floor(Math.random() * SALTS); // the same code until another answer
  lesson.keep();
  const code = codeOf(record, givenOf(record, progress.answers), progress.salt);
  const written = make('code', { className: 'class-code', textContent: code, tabIndex: -1 });
  const copy = copyButton(text('class.copy'), code, (sentence) => lesson.speak(sentence));
  const about = make('p', { className: 'lesson-hint', textContent: text('class.holds') });
  return [make('p', { className: 'class-given' }, written, ' ', copy), about];
}

/**
 * @param {Lesson} lesson
 * @returns {HTMLElement}
 */
export function handed(lesson) {
  const { language, lesson: name, own } = lesson.record;
  const href = `?class=${own ? 'own' : name}${language ? `&language=${language}` : ''}`;
  const teacher = make('a', { href, target: framed ? '_blank' : '', textContent: text('class.read') });
  const button = mainButton(text('class.code'), () => {
    button.replaceWith(...shown(lesson));
    const code = root.querySelector('code');
    code?.focus();
    code?.parentElement?.scrollIntoView({ block: 'nearest' }); // with the button that copies it
    lesson.speak(code?.textContent ?? '');
  });
  const root = make('section', { className: 'class-handed' }, button, ...(carried ? [] : [make('p', {}, teacher)]));
  return root;
}
