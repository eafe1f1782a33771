// A line over time is drawn before it is seen: by pointer, by keys, or as points. Then it is laid over what happens.
import { cleared } from '../charts/canvas.js';
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { figures } from '../text/format.js';
import { mainButton, signOf } from './answered.js';
import * as drawing from './drawing.js';
import { curveOf, timeOf, valueOf } from './events.js';
import { BIN, curveOver, judged } from './judge.js';
import { Drawn, pointsOf } from './line.js';
import { elementsOf, wordsOf } from './nodes.js';
import { nameOf } from './settings.js';
import { sketched, soOf } from './sketched.js';

/** @import { Frame } from '../messages.js' */
/** @import { Judgement } from './judge.js' */
/** @import { Lesson } from './lesson.js' */
/** @import { Part, Question } from './questions.js' */

export const FACTORS = /** @type {Record<string, number>} */ ({ kN: 1e-3 }); // that a unit has of one of SI
export const SHORT = 0.1; // T at the end, that a line may leave out

/**
 * What is so, in units of the chart.
 * @param {Part} part
 * @param {Frame} frame
 */
export const soIn = (part, frame) => (part.settings ? curveOver(part.truth) : curveOf(frame, FACTORS[part.unit] ?? 1));

/** @implements {Question} */
export class Sketch {
  predicts = true;
  /** @type {import('../charts/scale.js').Samples} */ curve = { x: [], y: [] };
  /** @type {Judgement[]} */ judgements = [];
  /** @type {drawing.Paper | null} */ paper = null;
  seen = Infinity; // until when it is seen what happens [T]
  unrolling = false;
  lit = -1; // the sentence that is pointed at
  /** @type {[t: number, value: number] | null} */ near = null; // a pointer
  finger = false;
  tools = make('div', { className: 'sketch-tools' });
  canvas = make('canvas', { ariaHidden: 'true' });
  plot = make('div', { className: 'sketch-plot', tabIndex: 0 });
  sheet = make('div', { className: 'sketch-sheet' });
  points = make('div', { className: 'sketch-points', hidden: true });
  hint = make('p', { className: 'lesson-hint' });
  show_ = mainButton(text('lesson.show'), () => this.#tell());
  /** @type {HTMLElement[]} */ sentences = [];

  /**
   * @param {Lesson} lesson
   * @param {Part} part
   */
  constructor(lesson, part) {
    this.lesson = lesson;
    this.part = part;
    this.answer = lesson.answerOf(part.name, { line: null, done: false, laid: false, late: false, outcomes: [] });
    const { line } = this.answer;
    this.measured = typeof part.until === 'number';
    this.drawn = this.#blank(this.measured ? part.until : line ? (line.length - 1) * BIN : 1);
    this.root = make('div', { className: 'lesson-sketch' });
    this.name = nameOf(part);
    this.section = this.#chart();
    this.#render();
  }
  get done() {
    return this.answer.done;
  }
  /** Whether the rows stand in the place of the chart. */
  get laid() {
    return this.answer.done && this.answer.laid;
  }
  /** @returns {HTMLElement | undefined} */
  get chart() {
    return this.section;
  }
  /** Whether what happens comes with the clock. */
  get rolls() {
    return true;
  }
  /** @param {number} until  [T] */
  #blank(until) {
    const { axis, given, settings } = this.part;
    return new Drawn({ axis, given, until, zeroed: !settings }, this.answer.line);
  }
  /** The scene is there, and with it the event until which one draws; from now on the chart stays as long. */
  #measure() {
    this.measured = true;
    this.drawn = this.#blank(timeOf(this.part.until, this.lesson.events) || 1);
    this.#render();
    this.draw();
  }
  #chart() {
    const { canvas, name, plot, points, sheet, tools } = this;
    const tool = (/** @type {string} */ code, /** @type {() => void} */ onclick) =>
      make('button', { type: 'button', textContent: text(code), onclick });
    tools.append(
      tool('lesson.undo', () => this.#undo()),
      tool('lesson.clear', () => [this.drawn.clear(), this.#changed()]),
      tool('lesson.type', () => (points.hidden = !points.hidden)),
    );
    const head = make('div', { className: 'sketch-head' }, make('span', { textContent: name }), tools);
    plot.setAttribute('role', 'application');
    sheet.append(canvas, plot);
    points.append(...this.#typing());
    this.#listen();
    new ResizeObserver(() => this.draw()).observe(sheet);
    return make('section', { className: 'sketch', ariaLabel: name }, head, sheet, points);
  }
  get pointsSuch() {
    return '0 37\n1 37';
  }
  get pointsAbout() {
    return text('lesson.points', { unit: this.part.unit });
  }
  /** @param {[t: number, value: number][]} points  as they are typed */
  taken(points) {
    return points;
  }
  #typing() {
    const area = make('textarea', { rows: 5, spellcheck: false, placeholder: this.pointsSuch });
    const label = make('label', {}, this.pointsAbout, area);
    const wrong = make('p', { className: 'wrong', role: 'status', hidden: true });
    const act = () => {
      const bad = area.value.split('\n').filter((each) => each.trim() && !pointsOf(each).length);
      wrong.hidden = !bad.length;
      wrong.textContent = text('lesson.not-points', { lines: bad.slice(0, 3).join('; ').slice(0, 80) });
      if (bad.length) return;
      const points = this.taken(pointsOf(area.value));
      this.drawn.type(points);
      this.#changed();
      this.lesson.speak(text('lesson.typed', { count: points.length }));
    };
    const draw = make('button', { type: 'button', className: 'whole', textContent: text('lesson.draw'), onclick: act });
    return [label, draw, wrong];
  }
  #listen() {
    const { plot } = this;
    const at = (/** @type {PointerEvent} */ { clientX, clientY }) => {
      const { left, top } = plot.getBoundingClientRect();
      return this.paper?.at(clientX - left, clientY - top) ?? null;
    };
    // Else a quick stroke counts as a fling, and swallows the next tap.
    plot.addEventListener('touchstart', (event) => this.done || event.preventDefault(), { passive: false });
    plot.onpointerdown = (event) => {
      const here = at(event);
      if (event.button !== 0 || !here) return;
      if (this.done) {
        this.stand(here[0]);
        return;
      }
      plot.setPointerCapture(event.pointerId);
      this.finger = event.pointerType === 'touch';
      this.drawn.pen = null;
      this.drawn.stroke();
      this.drawn.ink(here, here);
      this.near = here;
      this.draw();
      plot.onpointermove = (moved) => {
        for (const each of moved.getCoalescedEvents?.() ?? [moved]) this.#stroke(at(each));
        this.#stroke(at(moved));
        this.draw();
      };
    };
    plot.onpointerup = plot.onpointercancel = () => {
      if (!plot.onpointermove) return;
      plot.onpointermove = null;
      this.near = null;
      this.#changed();
    };
    plot.onkeydown = (event) => this.#key(event);
    plot.onblur = () => this.draw();
    plot.onfocus = () => this.draw();
  }
  /** @param {number} t */
  stand(t) {
    this.lesson.stand(t);
  }
  /** @param {[t: number, value: number] | null} to */
  #stroke(to) {
    if (!to || !this.near) return;
    this.drawn.ink(this.near, to);
    this.near = to;
  }
  /** @param {KeyboardEvent} event */
  #key(event) {
    if (this.done || event.altKey) return;
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === 'z') {
      event.preventDefault();
      this.#undo();
      return;
    }
    if (event.ctrlKey || event.metaKey || !this.drawn.key(event.key, event.shiftKey)) return;
    event.preventDefault();
    event.stopPropagation();
    const { lifted } = this.drawn;
    this.#changed();
    this.lesson.speak(event.key === ' ' ? text('lesson.pen', { lifted }) : this.words(this.drawn.take()));
  }
  /** @param {[t: number, value: number]} point */
  words([t, value]) {
    return text('lesson.point', { time: this.lesson.timeWords(t), value: figures(value, 3), unit: this.part.unit });
  }
  #undo() {
    this.drawn.undo();
    this.#changed();
  }
  #changed() {
    this.answer.line = this.drawn.kept;
    this.lesson.keep();
    this.#enable();
    this.draw();
  }
  /** What the chart is called. */
  #call() {
    const drawn = this.done ? 'done' : this.drawn.begun ? 'some' : 'no';
    this.plot.ariaLabel = text('lesson.chart', {
      ...{ drawn, name: this.name, until: this.untilWords },
    });
  }
  get untilWords() {
    return this.lesson.timeWords(this.drawn.until);
  }
  /** What is still to be done. */
  get drawOn() {
    return text('lesson.draw-on', { begun: this.drawn.begun, until: this.untilWords });
  }
  get whole() {
    return this.drawn.reach >= this.drawn.until - SHORT;
  }
  #enable() {
    this.#call();
    const tools = /** @type {HTMLButtonElement[]} */ ([...this.tools.children]);
    const focused = tools.find((each) => each.matches(':focus'));
    [tools[0].disabled, tools[1].disabled] = [!this.drawn.undone.length, !this.drawn.begun];
    if (focused?.disabled) this.plot.focus(); // else keys would begin at the top again
    this.show_.disabled = !this.whole;
    this.hint.textContent = this.whole || !this.measured ? '' : this.drawOn;
  }
  #render() {
    const { answer } = this;
    this.tools.hidden = answer.done;
    this.points.hidden = true;
    this.plot.hidden = answer.done && !this.rolls; // what lies below it goes on
    this.sheet.classList.toggle('done', answer.done);
    if (!answer.done) {
      this.root.replaceChildren(this.show_, this.hint);
      this.#enable();
      return;
    }
    this.#call();
    this.sentences = this.judgements.map((judgement, k) => this.#sentence(judgement, k));
    const list = make('ul', { className: 'lesson-judged', tabIndex: -1 }, ...this.sentences);
    const late = make('p', { className: 'lesson-hint', textContent: text('lesson.late') });
    this.root.replaceChildren(list, ...(answer.late ? [late] : []), ...(this.rolls ? [this.#layer()] : []));
    this.#reveal();
  }
  /** The button that lays the line beside the picture, and back. */
  #layer() {
    const { laid } = this.answer;
    const lay = mainButton(text(laid ? 'lesson.stand' : 'lesson.lay'), () => this.#lay());
    lay.classList.toggle('plain', laid);
    return lay;
  }
  /**
   * @param {Judgement} judgement
   * @param {number} k
   */
  #sentence(judgement, k) {
    const { outcome, span, yours } = judgement;
    const light = (/** @type {number} */ lit) => {
      this.lit = lit;
      this.draw();
    };
    const words = make('span', {}, ...elementsOf(this.part.judges[k].says[outcome] ?? [], this.gaps(judgement)));
    const sign = signOf(outcome === 'yes');
    const button = make('button', { type: 'button' }, sign, words);
    button.onclick = () => this.stand(Number.isFinite(yours) ? yours : span[0]);
    button.onpointerenter = button.onfocus = () => light(k);
    button.onpointerleave = button.onblur = () => light(-1);
    return make('li', {}, button);
  }
  /** @param {Judgement} judgement */
  gaps({ right, yours }) {
    return { yours: this.lesson.timeWords(yours), true: this.lesson.timeWords(right) };
  }
  #tell() {
    if (!this.whole) return;
    const { answer, lesson } = this;
    this.drawn.pen = this.near = null;
    Object.assign(answer, { line: this.drawn.kept, done: true, late: lesson.looked });
    this.load(lesson.page.frame);
    answer.so = soOf(this.drawn.line.length, valueOf(this.curve));
    answer.outcomes = this.judgements.map(({ outcome, right, ring, to, yours }) => ({
      outcome,
      right,
      ring,
      to,
      yours,
    }));
    this.unrolling = this.rolls && !lesson.still;
    this.seen = this.unrolling ? 0 : Infinity;
    this.#render();
    lesson.answered(this.unrolling ? '' : this.#all());
    this.draw();
  }
  #all() {
    return this.judgements
      .map((each, k) => wordsOf(this.part.judges[k].says[each.outcome] ?? [], this.gaps(each)))
      .join(' ');
  }
  #lay() {
    this.answer.laid = !this.answer.laid;
    this.unrolling = false;
    this.seen = Infinity;
    this.lesson.keep();
    this.#render();
    this.lesson.arrange();
  }
  /** @param {Frame} frame */
  load(frame) {
    if (this.lesson.coming) return;
    if (!this.measured) this.#measure();
    if (!this.done) return; // nothing of what happens is here before
    const { judges } = this.part;
    this.curve = soIn(this.part, frame);
    const { events } = this.lesson;
    const criteria = judges.map((/** @type {Part} */ each) => ({
      ...each,
      at: Array.isArray(each.at) ? each.at.map((time) => timeOf(time, events)) : timeOf(each.at, events),
    }));
    this.judgements = judged(this.drawn.line, criteria, this.part.axis, valueOf(this.curve));
    this.#render();
    this.draw();
  }
  /** The own line as a curve, to lie beside the rod in its unit of SI. */
  get series() {
    const factor = 1 / (FACTORS[this.part.unit] ?? 1);
    const all = this.drawn.line.map((value, k) => [0.01 * k, value]).filter(([, value]) => !Number.isNaN(value));
    const style = /** @type {const} */ ('keptB');
    return { x: all.map(([t]) => t), y: all.map(([, value]) => value), factor, style, cursor: text('lesson.yours') };
  }
  /** @param {number} t */
  show(t) {
    if (!this.unrolling) return;
    const { page } = this.lesson;
    const over = t >= this.drawn.until - 1e-6 || !page.player.playing;
    this.seen = over && this.seen > 0 ? Infinity : Math.max(this.seen, t);
    this.unrolling = this.seen < Infinity;
    if (!this.unrolling) this.lesson.speak(this.#all());
    this.#reveal();
    this.draw();
  }
  /** Sentences come when the clock is there. */
  #reveal() {
    this.sentences.forEach((each, k) => {
      const { ring, to } = this.judgements[k];
      each.classList.toggle('later', Math.max(ring[0], to[0]) > this.seen);
    });
  }
  draw() {
    const { drawn, lit, done } = this;
    if (!this.section.isConnected || !this.measured) return;
    const sheet = cleared(this.canvas, this.sheet);
    if (!sheet) return;
    const { c, height, width } = sheet;
    const paper = new drawing.Paper(width, height, drawn);
    this.paper = paper;
    Object.assign(this.plot.style, {
      ...{ left: `${paper.left}px`, top: `${paper.top}px` },
      ...{ width: `${paper.wide}px`, height: `${paper.tall}px` },
    });
    drawing.axes(c, paper);
    if (done) drawing.truth(c, paper, this.curve, this.seen);
    drawing.own(c, paper, drawn.line, done);
    if (done && this.seen >= drawn.until) drawing.happens(c, paper, this.curve, drawn.line);
    if (drawn.given && !done) drawing.dot(c, paper, drawn.given);
    if (done)
      this.judgements.forEach((each, k) => {
        if (Math.max(each.ring[0], each.to[0]) <= this.seen) drawing.mark(c, paper, each, k === lit);
      });
    const { pen } = this;
    if (pen && !done) drawing.pen(c, paper, pen, this.words(pen), this.finger && Boolean(this.near));
  }
  /** Where the pen is, by whatever moves it. */
  get pen() {
    const root = /** @type {Document | ShadowRoot} */ (this.plot.getRootNode());
    const keys = root.activeElement === this.plot && this.drawn.pen;
    return this.near ?? (keys || null);
  }
  said() {
    const lines = this.answer.outcomes.map((/** @type {Judgement} */ each, /** @type {number} */ k) => {
      const say = this.part.judges[k].says[each.outcome] ?? [];
      return make('li', {}, signOf(each.outcome === 'yes'), make('span', {}, ...elementsOf(say, this.gaps(each))));
    });
    const { line, so } = this.answer;
    const picture = line ? [sketched(line, so, this.part.axis, this.name)] : [];
    return [make('div', {}, ...picture, make('ul', { className: 'lesson-judged' }, ...lines))];
  }
}
