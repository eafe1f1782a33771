// The clock: play, step, jump from event to event, loop, pace. It runs in the browser alone; nothing is sent meanwhile.
import { text } from '../text/catalogue.js';
import { signed } from '../text/format.js';
import { make, write } from '../browser/dom.js';
import { PaceMenu } from './pace.js';
import { times, unitOfTime } from './times.js';

/** @import { Chosen } from '../messages.js' */
/** @import { Event } from '../frame/story.js' */

const FULL = 10000; // steps of the time bar
const SECONDS_PER_UNIT = 3; // of time, at least
const SECONDS = 30; // that a long one plays
const MOST_WAITS = 6; // of a tour
const STEP = 1 / 250; // of what is in view
const AGAIN = 900; // ms at the end of a loop before it begins again
const HAND = 700; // ms for which time stands still after a slider has moved: what changes then, the slider did
const READING = 140; // ms for a word of a caption
/** @type {[least: number, most: number]} */
const CAPTION = [1200, 3500]; // ms for which a caption is waited for
const EARLY = 0.01; // of the whole
const LEAST = 1e-9; // of the whole, that is more than rounding
const EARLIER = 0.5; // seconds of playback: who jumps back while it plays means the event before the last

/** @type {[name: string, sign: string, key: string, way: number][]} */
const MOVES = [
  ['previous', '|◀', '[', -1],
  ['back', '◂', ',', -1],
  ['forward', '▸', '.', 1],
  ['next', '▶|', ']', 1],
];

/** @typedef {(t: number) => string} Said  what the clock says, if not the time */
/**
 * What it runs through.
 * @typedef {object} Run
 * @property {string} kind  of what is shown, which keeps the instant from scene to scene
 * @property {Chosen['scene']} scene
 * @property {number} [start]  in units of time; 0 by default
 * @property {number} length
 * @property {number} unit  seconds in a unit of time
 * @property {boolean} [trips]  whether that is a round trip
 * @property {number} [perSecond]  units that a second of playback takes
 * @property {number} first  instant that is shown at first, from the start on
 * @property {number | null} time  at which the scene is to be seen [s]
 * @property {Said | null} [said]
 */

/**
 * What the clock asks of the page. Times as those that `show` is given.
 * @typedef {object} Score
 * @property {() => Event[]} events
 * @property {() => [start: number, end: number]} range  in view
 * @property {() => void} taken  a hand has taken the clock
 * @property {(holding: boolean) => void} hold  the clock waits for the caption to be read, or goes on
 */

export class Player {
  t = 0; // from the beginning of what is shown
  start = 0;
  duration = 0;
  trip = 0; // seconds in a unit of time
  inTrips = true;
  perSecond = 1; // units of time in a second of playback
  usual = 1;
  until = Infinity;
  limit = Infinity; // beyond which the clock does not go, whoever asks
  last = 0; // when the last frame was drawn
  playing = false;
  played = false; // ever, by hand
  looping = true;
  touring = false; // waits at every event for its caption to be read
  waited = 0; // events of this tour
  waits = 0; // until when the clock stands
  scene = '';
  stands = false; // the scene is to be seen at an instant of its own
  beyond = false; // the clock is out of what charts show, and its bar spans all there is
  held = false; // a hand drags along the bar, which stays as it is meanwhile
  /** @type {Said | null} */ said = null;
  was = ''; // the kind that was shown

  /**
   * `show(t)` draws the instant t [round trips].
   * @param {(t: number) => void} show
   * @param {Score} score
   */
  constructor(show, score) {
    this.show = show;
    this.score = score;
    const button = (/** @type {string} */ name, /** @type {string} */ sign, /** @type {() => void} */ onclick) =>
      make('button', { type: 'button', className: `move ${name}`, textContent: sign, onclick });
    this.button = make('button', { type: 'button', className: 'play', onclick: () => this.toggle() });
    this.moves = MOVES.map(([name, sign, key, way]) => {
      const act = name === 'previous' || name === 'next' ? () => this.jump(way) : () => this.step(way);
      return this.#named(button(name, sign, act), text(`player.${name}`), key);
    });
    this.scrub = make('input', { type: 'range', min: 0, max: FULL, step: 1, className: 'scrub' });
    this.ticks = make('div', { className: 'ticks', ariaHidden: 'true' });
    this.pace = new PaceMenu(() => this.label());
    this.why = make('span', { className: 'why', hidden: true });
    this.clock = make('output', { className: 'clock', ariaLive: 'off' });
    this.loops = this.#named(
      button('loop', '⟲', () => this.loop()),
      text('player.loop'),
      'L',
    );
    this.track = make('div', { className: 'track' }, this.ticks, this.scrub);
    const time = make('div', { className: 'time' }, this.why, this.clock, this.track);
    this.root = make('div', { className: 'player' }, this.button, ...this.moves, time);
    this.root.append(this.pace.root, this.loops);
    this.scrub.oninput = () => {
      const [low, high] = this.bar;
      this.held = true;
      this.seek(low + (Number(this.scrub.value) / FULL) * (high - low));
      this.held = false;
    };
    this.run = this.run.bind(this);
    this.label();
  }
  /**
   * @param {HTMLButtonElement} button
   * @param {string} name
   * @param {string} key  that does the same
   */
  #named(button, name, key) {
    button.ariaLabel = name;
    button.title = `${name} (${key})`;
    button.setAttribute('aria-keyshortcuts', key);
    return button;
  }
  /** @param {Run} run */
  load({ first, kind, length, perSecond, said = null, scene, start = 0, time, trips = false, unit }) {
    this.start = start;
    this.said = said;
    this.duration = length;
    this.trip = unit;
    this.inTrips = trips;
    this.perSecond = this.usual = perSecond ?? Math.max(1 / SECONDS_PER_UNIT, length / SECONDS);
    this.until = Infinity;
    if (this.was !== kind) this.t = first;
    const other = this.scene !== scene;
    if (this.playing && other) this.t = 0;
    this.stands = time !== null;
    if (other && time !== null) this.#stand(time / unit - start);
    this.was = kind;
    this.scene = String(scene);
    this.t = Math.min(this.t, this.duration, this.limit);
    this.label();
    this.go(this.t);
  }
  /** @param {number} t  that a scene is to be seen at */
  #stand(t) {
    this.playing = false;
    this.t = t;
  }
  label() {
    write(this.button, this.playing ? '❚❚' : '▶');
    this.button.ariaLabel = this.playing ? text('player.pause') : text('player.play');
    this.button.title = text('player.by-space', { name: this.button.ariaLabel });
    this.loops.ariaPressed = String(this.looping);
    if (this.trip) this.pace.load(this.usual * this.trip);
  }
  /** @returns {[low: number, high: number]} the stretch of time that charts show, as far as there is any */
  get #shown() {
    const [low, high] = this.score.range().map((t) => Math.min(Math.max(t - this.start, 0), this.duration));
    const end = Math.min(high, this.limit || high);
    return end > low ? [low, end] : [0, this.duration];
  }
  /** @returns {[low: number, high: number]} the stretch that the time bar spans and that is played */
  get bar() {
    return this.beyond ? [0, Math.min(this.duration, this.limit || this.duration)] : this.#shown;
  }
  /** Whether the clock is out of what charts show. */
  get #out() {
    const [[low, high], least] = [this.#shown, LEAST * this.duration];
    return this.t < low - least || this.t > high + least;
  }
  /**
   * The bar spans all where the clock has gone out of what charts show.
   * @param {boolean} moved  the clock, else what is shown
   */
  #follow(moved) {
    const beyond = this.#out && (moved || this.beyond);
    if (this.held || beyond === this.beyond) return;
    this.beyond = beyond;
    this.#divide();
  }
  /** Charts show another stretch: that is what plays. */
  look() {
    this.beyond = false;
    if (this.playing && this.#out) this.go(this.#shown[0]);
    this.mark();
  }
  /**
   * @param {number} limit  where it is zero, nothing can be played
   * @param {string} [why]  that is so
   */
  bound(limit, why = '') {
    this.limit = limit;
    this.button.disabled = this.scrub.disabled = limit <= 0;
    write(this.why, limit > 0 ? '' : why);
    this.why.hidden = !this.why.textContent;
    this.go(this.t);
    this.mark();
  }
  /** Where the clock and the events are, on the time bar. */
  mark() {
    this.#follow(false);
    this.#divide();
    this.#place();
  }
  /** Events, on the time bar. */
  #divide() {
    const [low, high] = this.bar;
    const signs = this.score.events().flatMap(([t, sentence]) => {
      const share = (t - this.start - low) / (high - low);
      if (share < 0 || share > 1) return [];
      const sign = make('i', { title: sentence });
      sign.style.left = `${100 * share}%`;
      return [sign];
    });
    this.ticks.replaceChildren(...signs);
    const part = high - low < this.duration * (1 - LEAST);
    this.track.classList.toggle('part', part);
    this.scrub.ariaLabel = text('player.time', { part });
  }
  #place() {
    const [low, high] = this.bar;
    this.scrub.value = String(Math.round(((this.t - low) / (high - low)) * FULL));
  }
  /** Play from the beginning, waiting at every event; the second time round without. */
  tour() {
    if (this.stands || !this.limit) return;
    this.touring = true;
    this.waited = 0;
    this.go(0);
    this.#play();
  }
  #play() {
    const idle = !this.playing;
    this.playing = true;
    this.last = 0;
    this.label();
    if (idle) requestAnimationFrame(this.run);
  }
  /** @param {Event} event  whose caption is to be read */
  #wait(event) {
    const [least, most] = CAPTION;
    const wait = Math.min(Math.max(READING * event[1].split(' ').length, least), most);
    this.waits = performance.now() + wait;
    this.button.style.setProperty('--wait', `${wait}ms`);
    this.#hold(true);
  }
  /** @param {boolean} holding  the clock, which is seen on its button */
  #hold(holding) {
    this.button.classList.toggle('held', holding);
    this.score.hold(holding);
  }
  /** The hand has taken the clock: nothing is waited for any more. */
  #taken() {
    this.played = true;
    this.touring = false;
    this.waits = 0;
    this.#hold(false);
    this.score.taken();
  }
  /**
   * Play a stretch of time, to last so many seconds.
   * @param {number} start
   * @param {number} end
   * @param {number} seconds
   */
  through(start, end, seconds) {
    this.#taken();
    this.perSecond = (end - start) / seconds;
    this.until = end;
    this.go(start);
    this.#play();
  }
  toggle() {
    this.#taken();
    this.perSecond = this.usual;
    this.until = Infinity;
    if (this.playing) {
      this.playing = false;
      this.label();
      return;
    }
    const [low, high] = this.bar;
    if (this.t < low || this.t >= Math.min(high, this.limit) - LEAST * this.duration) this.go(this.#shown[0]);
    this.#play();
  }
  loop() {
    this.looping = !this.looping;
    this.label();
  }
  /**
   * A hand sets the clock; it plays on from there if it was playing.
   * @param {number} t
   */
  seek(t) {
    this.#taken();
    this.go(t);
  }
  /** @param {number} way  steps */
  step(way) {
    const [start, end] = this.score.range();
    if (this.playing) this.toggle();
    this.seek(this.t + way * STEP * (end - start));
  }
  /** @param {number} way  to the event before or after */
  jump(way) {
    const now = this.t + this.start;
    const instants = this.score.events().map(([t]) => t);
    const least = LEAST * this.duration;
    const before = this.playing ? EARLIER * this.perSecond * this.pace.speed : least;
    const to = way > 0 ? instants.find((t) => t > now + least) : instants.findLast((t) => t < now - before);
    this.seek(to === undefined ? (way > 0 ? this.duration : 0) : to - this.start);
  }
  /** A slider moves: time stands still meanwhile. */
  rest() {
    if (this.playing) this.waits = Math.max(this.waits, performance.now() + HAND);
  }
  /** @param {number} now */
  run(now) {
    if (!this.playing || !this.root.isConnected) return;
    requestAnimationFrame(this.run);
    const elapsed = this.last ? Math.min(now - this.last, 100) / 1000 : 0;
    this.last = now;
    if (now < this.waits) return;
    if (this.waits) this.#hold(false);
    this.waits = 0;
    const [, high] = this.bar;
    const end = Math.min(this.until < Infinity ? Math.min(this.until, this.duration) : high, this.limit);
    if (this.t >= end) this.#ended(this.until < Infinity ? 0 : this.#shown[0]);
    else this.#onwards(Math.min(this.t + elapsed * this.perSecond * this.pace.speed, end), end);
  }
  /**
   * @param {number} t
   * @param {number} end
   */
  #onwards(t, end) {
    const from = this.t + this.start;
    const early = this.start + EARLY * this.duration; // what it begins with is said while it moves
    const meets = (/** @type {Event} */ [when]) => when > Math.max(from, early) && when <= t + this.start;
    const met = this.touring && this.waited < MOST_WAITS ? this.score.events().find(meets) : undefined;
    this.go(met ? met[0] - this.start : t);
    this.waited += met ? 1 : 0;
    if (met) this.#wait(met);
    else if (t >= end && this.looping) this.waits = performance.now() + AGAIN;
  }
  /** @param {number} start  of what is looped */
  #ended(start) {
    this.touring = false;
    if (this.looping) {
      this.go(start);
      return;
    }
    this.playing = false;
    this.label();
  }
  /** @param {number} t */
  go(t) {
    const before = this.t;
    this.t = Math.min(Math.max(t, 0), this.duration, this.limit);
    this.#follow(this.t !== before);
    this.#place();
    const now = this.t + this.start;
    const real = now * this.trip;
    const [factor, unit] = unitOfTime(Math.abs(real));
    const seconds = `${signed(real * factor, 1)} ${unit}`;
    this.clock.dataset.term = this.inTrips && !times.inSeconds ? 'T' : '';
    const [perTrip, chosen] = times.shown;
    const trips = times.inSeconds || times.bare ? '' : ` = ${seconds}`;
    const time = this.inTrips ? `${signed(this.t * perTrip)} ${chosen}${trips}` : seconds;
    write(this.clock, this.said ? this.said(now) : time);
    this.scrub.ariaValueText = this.clock.textContent;
    this.show(now);
  }
  /**
   * What a key does to the clock. Whether it does anything.
   * @param {KeyboardEvent} event
   */
  key(event) {
    /** @type {Record<string, () => void>} */
    const keys = {
      ' ': () => this.toggle(),
      ',': () => this.step(-1),
      '.': () => this.step(1),
      '[': () => this.jump(-1),
      ']': () => this.jump(1),
      l: () => this.loop(),
      '<': () => this.pace.next(-1),
      '>': () => this.pace.next(1),
    };
    const act = keys[event.key.toLowerCase()];
    act?.();
    return Boolean(act);
  }
}
