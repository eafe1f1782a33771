// Stands for the component of Panel where there is no server: what is chosen is answered here, by the library's
// kernels, of scenes that came with the page.
import { OFFERED } from '../frame/layout.js';
import { decode } from '../wire/message.js';
import { encode } from './encode.js';
import { choicesIn, fixed, refusal, refusalOf } from './choices.js';

/** @import { Chosen, Frame, Try } from '../messages.js' */
/** @import { Model, Spec } from '../wire/model.js' */
/** @import { Answers } from '../wire/own_answers.js' */
/** @import { Note } from '../text/catalogue.js' */

export class Offline {
  /** @type {Map<string, Frame>} */ scenes = new Map(); // those that have been asked for
  /** @type {Map<string, (() => void)[]>} */ heard = new Map();
  /** @type {Chosen} */ shown;
  due = false; // choices are to be answered

  /**
   * @param {{ messages: ArrayBuffer[], spec: Spec }} carried
   * @param {Answers} answers
   * @param {string} search  of the address
   */
  constructor({ messages, spec }, answers, search) {
    this.answers = answers;
    this.messages = messages; // in the order of the options
    this.spec = spec;
    const [chosen, refused] = choicesIn(search, this);
    /** @type {Record<string, any>} */
    this.values = {
      ...{ spec, shared: { panels: {}, asked: {} }, waiting: '', disconnected: '' },
      ...{ on: this.#listen.bind(this), ...chosen },
      refused: refused.length ? JSON.stringify(refused) : '',
    };
    this.model = /** @type {Model} */ (
      new Proxy(this.values, { set: (_, name, value) => this.#set(String(name), value) })
    );
    const found = this.#found(chosen);
    const shown = 'code' in found ? this.#opened(chosen, found) : found;
    if ('code' in shown) throw new Error(shown.code);
    this.#show(shown);
  }
  /**
   * A scene as it opens, where a link asks for more than can be answered, which is said.
   * @param {Chosen} chosen
   * @param {Note} why
   */
  #opened(chosen, why) {
    const own = this.scene(chosen.scene)?.chosen ?? chosen;
    Object.assign(this.values, own, { refused: JSON.stringify([why]) });
    return this.#found(own);
  }
  /**
   * As the library has solved it, without what kernels make anew; nothing where it is not here.
   * @param {unknown} name
   * @returns {Frame | null}
   */
  scene(name) {
    const { messages, scenes, spec } = this;
    const place = spec.scene.options?.indexOf(String(name)) ?? -1;
    if (place < 0) return null;
    const frame = scenes.get(String(name)) ?? this.#offered(decode(messages[place]));
    scenes.set(String(name), frame);
    return frame;
  }
  /**
   * A scene with what can be done to it here.
   * @param {Frame} frame
   * @returns {Frame}
   */
  #offered(frame) {
    const acting = this.#acting(frame);
    const { opens } = frame;
    const within = (/** @type {object} */ choices) => Object.keys(choices).every((name) => acting.includes(name));
    const trials = opens.trials.filter(([, name]) => acting.includes(name));
    const compare = opens.compare.filter(({ first, second }) => within(first) && within(second));
    const tab = opens.tab && OFFERED.includes(opens.tab) ? opens.tab : null;
    return /** @type {Frame} */ ({ ...frame, acting, opens: { ...opens, trials, compare, tab } });
  }
  /** @param {Frame} frame */
  #acting(frame) {
    return frame.acting.filter((name) => name === 'scene' || this.answers.covers(frame, [name]));
  }
  /**
   * @param {string} name
   * @param {() => void} act
   */
  #listen(name, act) {
    this.heard.set(name, [...(this.heard.get(name) ?? []), act]);
  }
  /** @param {string} name */
  #tell(name) {
    for (const act of this.heard.get(name) ?? []) act();
  }
  /**
   * @param {string} name
   * @param {unknown} value
   */
  #put(name, value) {
    if (Object.is(this.values[name], value)) return;
    this.values[name] = value;
    this.#tell(name);
  }
  /**
   * Set by the page. What is set together is answered together.
   * @param {string} name
   * @param {unknown} value
   */
  #set(name, value) {
    this.#put(name, value);
    if (name in this.spec && !this.due) {
      this.due = true;
      Promise.resolve().then(() => this.#answer());
    }
    return true;
  }
  /** @returns {Chosen} */
  get #chosen() {
    return /** @type {Chosen} */ (Object.fromEntries(Object.keys(this.spec).map((name) => [name, this.values[name]])));
  }
  #answer() {
    this.due = false;
    this.values.refused = '';
    const base = this.scene(this.values.scene);
    if (base && this.values.scene !== this.shown.scene) this.#choose(base.chosen); // it brings its own values
    const found = this.#found(this.#chosen);
    if (!('code' in found)) {
      this.#show(found);
      return;
    }
    this.#choose(this.shown);
    this.#put('refused', JSON.stringify([found]));
  }
  /** @param {Chosen} chosen */
  #choose(chosen) {
    for (const [name, value] of Object.entries(chosen)) this.#put(name, value);
  }
  /** @param {Frame} frame */
  #show(frame) {
    this.shown = frame.chosen;
    this.#put('frame', encode(frame));
  }
  /**
   * The answer, or why there is none.
   * @param {Chosen} chosen
   * @returns {Frame | Note}
   */
  #found(chosen) {
    const base = this.scene(chosen.scene);
    if (!base) return refusal('offline.scene');
    const changed = Object.keys(chosen).filter((name) => !Object.is(chosen[name], base.chosen[name]));
    for (const name of changed) {
      const why = refusalOf(name, chosen[name], this.spec);
      if (why) return why;
      if (!this.answers.covers(base, [name])) return fixed(name);
    }
    try {
      const frame = this.answers.covers(base, changed) && this.answers.answer(base, chosen);
      return frame ? { ...withTrials(frame, this.spec), acting: this.#acting(frame) } : refusal('offline.beyond');
    } catch {
      return refusal('offline.trap');
    }
  }
}

/** @type {Record<string, number>} */
const TIMES = { faster: 2, heavier: 1 / 4 }; // of what is shown, is tried: as in app/choices/kinds.py

/**
 * With the trials of what is shown: none of what is so already, and none that is softer once something gives way.
 * @param {Frame} frame
 * @param {Spec} spec
 */
function withTrials(frame, spec) {
  const { chosen, opens } = frame;
  const trials = opens.trials.flatMap((trial) => {
    const [say, name] = trial;
    const times = TIMES[say];
    const value = times ? times * Number(chosen[name]) : trial[2];
    const within = !times || (Number(value) >= spec[name].low && Number(value) <= spec[name].high);
    const softens = say === 'softer' && !('rigid' in frame && frame.rigid);
    return within && !softens && chosen[name] !== value ? [/** @type {Try} */ ([say, name, value])] : [];
  });
  return { ...frame, opens: { ...opens, trials } };
}
