// Lessons in the gallery: each with its picture, for whom it is, and how far one has come; and a file of one's own.
import { make } from '../browser/dom.js';
import { carried } from '../browser/home.js';
import { kept } from '../browser/store.js';
import { text } from '../text/catalogue.js';
import { lessonAt } from '../frame/address.js';
import { LessonFile } from './own_file.js';

/** @import { Gallery, Listed } from '../gallery/gallery.js' */
/** @typedef {{ canvas: HTMLCanvasElement, draw: () => void }} Picture  of a scene */
/** @typedef {(typed: string, words: string) => boolean} Finds */

/**
 * @typedef {object} Course  a lesson, as app/page/picker.py lists it
 * @property {string} name
 * @property {string} scene
 * @property {number} steps
 * @property {number | null} minutes
 * @property {string} language
 * @property {string} title
 * @property {string} before  the title until the first answer
 * @property {string} audience
 */
/** @typedef {{ of: string, far: number, answers: Record<string, { done?: boolean }> }} Progress  see lesson.js */

/**
 * How far one has come: whether the first question is answered, which step was reached, and whether all is done.
 * @param {Progress | null} progress
 * @param {number} steps
 */
export function reached(progress, steps) {
  try {
    if (!progress) return { answered: false, far: -1, done: false };
    /** @type {string[]} */
    const names = JSON.parse(progress.of).map((/** @type {string[]} */ [, name]) => name);
    const answered = names.map(
      (name) => Object.hasOwn(progress.answers, name) && Boolean(progress.answers[name]?.done),
    );
    const far = Math.min(progress.far, steps - 1);
    return { answered: answered[0] ?? true, far, done: far === steps - 1 && answered.every(Boolean) };
  } catch {
    return { answered: false, far: -1, done: false };
  }
}

export class Courses {
  /** @type {Picture[]} */ pictures = [];
  list = make('ul', { className: 'lesson-cards' });

  /**
   * @param {Gallery} gallery
   * @param {Listed['lessons']} lessons
   * @param {(scene: string) => Picture | null} pictureOf
   * @param {Finds} finds
   */
  constructor(gallery, lessons, pictureOf, finds) {
    this.finds = finds;
    this.file = new LessonFile(gallery);
    this.cards = lessons.map((course) => {
      const picture = pictureOf(course.scene);
      if (picture) this.pictures.push(picture);
      const words = make('div');
      const link = make('a', { href: lessonAt(course.name), className: 'card' });
      link.append(...(picture ? [picture.canvas] : []), words);
      this.list.append(make('li', {}, link));
      return { course, link, words };
    });
    const file = make('input', { type: 'file', accept: '.md,.markdown,text/markdown', hidden: true });
    file.onchange = () => {
      if (file.files?.[0]) this.file.open(file.files[0]);
      file.value = ''; // the same one may be chosen again, mended
    };
    const own = make('button', { type: 'button', className: 'whole', textContent: text('lesson.file') });
    own.onclick = () => file.click();
    const drop = make('span', { className: 'help', textContent: text('lesson.drop') });
    this.acts = make('div', { className: 'acts' }, own, drop, file);
    this.root = make('section', { className: 'lessons' }, make('h3', { textContent: text('gallery.lessons') }));
    this.root.append(this.list, ...(carried ? [] : [this.acts])); // a server reads files
  }
  /** With what the visitor has done by now. */
  draw() {
    for (const { course, link, words } of this.cards) {
      const { audience, before, language, minutes, name, steps, title } = course;
      const { answered, done, far } = reached(kept(`lesson.${name}`, null), steps);
      const about = [minutes ? text('lesson.minutes', { minutes }) : '', audience].filter(Boolean).join(' · ');
      const how = done ? text('lesson.done') : far < 0 ? '' : text('lesson.reached', { step: far + 1, steps });
      link.href = far > 0 ? `${lessonAt(name)}&step=${far + 1}` : lessonAt(name); // where one was
      words.lang = language;
      words.replaceChildren(
        make('strong', { textContent: answered ? title : before }),
        make('span', { textContent: about }),
        ...(how ? [make('em', { textContent: how, className: done ? 'done' : '' })] : []),
      );
    }
    for (const picture of this.pictures) picture.draw();
  }
  /** @param {string} typed  words that are searched */
  find(typed) {
    let found = 0;
    for (const { course, link, words } of this.cards) {
      const card = /** @type {HTMLElement} */ (link.parentElement);
      card.hidden = !this.finds(typed, [words.textContent, course.name, text('gallery.lessons')].join(' '));
      found += card.hidden ? 0 : 1;
    }
    this.acts.hidden = typed !== '';
    this.root.hidden = typed !== '' && !found;
  }
}
