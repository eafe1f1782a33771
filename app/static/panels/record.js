// A measured record beside the scene: sent to the server with the choices, drawn as it is moved and scaled.
import { entriesOf } from '../wire/body_values.js';
import { Figure } from '../charts/figure.js';
import { between } from '../charts/scale.js';
import { make } from '../browser/dom.js';
import { served } from '../browser/home.js';
import { placeOf } from '../place.js';
import { commaOf, numberInput } from '../form/number_field.js';
import { slides } from '../form/swipe.js';
import { said, text } from '../text/catalogue.js';
import { duration, figures, localised, signed } from '../text/format.js';
import { factorOf, typed } from '../text/units.js';

/** @import { Page } from '../page.js' */
/** @import { Frame } from '../messages.js' */
/** @import { Note } from '../text/catalogue.js' */

/** @typedef {'strain' | 'stress' | 'force'} Kind */
/**
 * @typedef {object} Compared  times in round trips, values in SI units
 * @property {Kind} kind
 * @property {number | null} at  the place of the gauge [m]; null of a force
 * @property {number[]} time  of the record, shifted and scaled to fit
 * @property {number[]} values
 * @property {{ time: number[], model: number[] }} computed
 * @property {{ time: number[], force: number[] } | null} [recovered]  the contact force that the record implies
 * @property {number} shift  [s]
 * @property {number} scale
 * @property {number} residual
 * @property {Note[]} notes
 * @property {number} trip  [s]
 */

const LIMIT = 2e6; // bytes
const EXAMPLE = { scene: 'bronze-rod-steel-ball', at: '1.0', kind: 'strain' };
/** @type {Record<Kind, [si: string, sign: string]>} */
const UNITS = { strain: ['m/m', 'µm/m'], stress: ['Pa', 'MPa'], force: ['N', 'kN'] };
const KINDS = ['file', 'strain', 'stress', 'force']; // of values, the first of them as the file says
const STEPS = 1000; // of the sliders
const ROWS = 21; // of the table
const LATER = 0.5; // T to both sides of the automatic shift
const LARGER = 5; // times the automatic scale, and as many times less

/**
 * @param {string} label
 * @param {HTMLElement} input
 */
const field = (label, input, unit = '') =>
  make('label', { className: 'part' }, make('span', {}, label), input, make('span', { className: 'unit' }, unit));

/**
 * @param {string} textContent
 * @param {() => void} onclick
 */
const button = (textContent, onclick) => make('button', { type: 'button', className: 'whole', textContent, onclick });

class Measurement {
  static beside = true; // has room in the dock; the charts stay
  /** @type {string[]} */ forKinds = []; // of scene, as Python says
  /** @type {File | null} */ file = null;
  /** @type {Compared | null} */ answer = null;
  /** @type {string | null} */ refusal = null;
  asking = false;
  again = false;

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    this.button = make('button', { type: 'button', textContent: text('record.button'), ariaPressed: 'false' });
    const part = { name: 'record', title: text('record.figure'), about: text('record.about') };
    this.figure = new Figure('record', [{ ...part, numbers: () => this.#numbers() }]);
    this.figure.whenReady(() => {
      const go = (/** @type {{ x: number }} */ { x }) => page.player.seek(Math.max(x, 0) * this.unit);
      this.figure.model('record').on_event('tap', go);
    });
    const onchange = () => this.ask();
    this.picker = make('input', { type: 'file', accept: '.csv,.txt,.tsv,.dat,text/*', hidden: true });
    const kinds = KINDS.map((kind, k) =>
      make('option', { value: k ? kind : '', textContent: text(`record.kind.${kind}`) }),
    );
    this.kind = make('select', { onchange }, ...kinds);
    this.at = Object.assign(numberInput(), { placeholder: '–', onchange });
    this.sign = make('input', { type: 'checkbox', onchange });
    this.name = make('span', { className: 'file-name' });
    this.name.textContent = text('record.drop');
    this.shift = this.#slider(text('record.shift-of'));
    this.scale = this.#slider(text('record.scale-of'));
    this.shiftSaid = make('output', { className: 'unit' });
    this.scaleSaid = make('output', { className: 'unit' });
    this.residual = make('output', { className: 'residual' });
    this.automatic = button(text('record.automatic'), () => this.reset());
    this.automatic.title = text('record.automatic-about');
    this.said = make('p', { className: 'help' });
    this.wrong = make('p', { className: 'wrong', role: 'alert' });
    this.result = make('div', { hidden: true }, this.figure.root, this.#movers(), this.said);
    const heading = make('h2', { textContent: text('record.heading') });
    this.root = make(
      'section',
      { className: 'analysis record-panel', hidden: true },
      heading,
      this.#form(),
      this.wrong,
      this.result,
    );
    this.#listen();
  }
  #listen() {
    this.picker.onchange = () => {
      if (this.picker.files?.length) this.takeFile(this.picker.files[0]);
      this.picker.value = '';
    };
    this.root.ondragover = (event) => event.preventDefault();
    this.root.ondrop = (event) => {
      event.preventDefault();
      if (event.dataTransfer?.files.length) this.takeFile(event.dataTransfer.files[0]);
    };
  }
  /** @param {string} ariaLabel */
  #slider(ariaLabel) {
    const middle = { min: 0, max: STEPS, value: STEPS / 2 };
    const slider = make('input', { type: 'range', ...middle, ariaLabel });
    slides(slider, () => this.moved());
    return slider;
  }
  #form() {
    const form = make(
      'div',
      { className: 'record-form' },
      button(text('record.choose'), () => this.picker.click()),
    );
    form.append(
      this.picker,
      button(text('record.example'), () => this.example()),
      this.name,
    );
    form.append(
      field(text('record.values'), this.kind),
      field(text('record.gauge'), this.at, text('record.gauge-unit')),
    );
    form.append(field(text('record.sign'), this.sign));
    return form;
  }
  #movers() {
    const shift = make('label', {}, make('span', { textContent: text('record.shift') }), this.shift, this.shiftSaid);
    const scale = make('label', {}, make('span', { textContent: text('record.scale') }), this.scale, this.scaleSaid);
    return make('div', { className: 'movers' }, shift, scale, this.residual, this.automatic);
  }
  get open() {
    return this.page.model.record_shown;
  }
  toggle() {
    this.page.model.record_shown = !this.open;
    this.#showOpen();
    if (this.open && this.answer) this.#plot(this.answer);
    this.ask();
    this.overlay();
    this.page.drawCharts();
  }
  /** Of the clock [s of a beam, T of others], in T. */
  get unit() {
    return 'main' in this.page.frame ? (this.answer?.trip ?? 1) : 1;
  }
  #showOpen() {
    this.root.hidden = !this.open;
    this.button.ariaPressed = String(this.open);
    if (!this.open) this.figure.close();
  }
  /** @param {File} file */
  takeFile(file, asks = true) {
    this.file = file;
    this.name.textContent = file.name;
    this.answer = this.refusal = null;
    this.wrong.textContent = '';
    this.result.hidden = true;
    if (asks) this.ask();
  }
  async example() {
    const record = await (await fetch(placeOf('example-record.csv'))).blob();
    this.kind.value = EXAMPLE.kind;
    this.at.value = EXAMPLE.at;
    this.sign.checked = false;
    const other = this.page.frame.chosen.scene !== EXAMPLE.scene;
    if (other) this.page.send('scene', EXAMPLE.scene); // and its answer asks for the comparison
    this.takeFile(new File([record], text('record.synthetic', { name: 'example-record.csv' })), !other);
  }
  /**
   * A new scene: the record in hand is drawn in its units at once, and compared anew.
   * @param {Frame} frame
   */
  take(frame) {
    const away = !this.forKinds.includes(frame.kind);
    this.button.disabled = away;
    this.button.hidden = 'mechanism' in frame && Boolean(frame.mechanism);
    this.button.title = text(away ? 'record.in-space' : 'record.title');
    this.#showOpen();
    this.root.classList.toggle('away', away);
    if (away) return;
    this.overlay();
    this.ask();
  }
  // One question at a time; when it is answered, the newest one is asked.
  async ask() {
    const { frame, names, waiter } = this.page;
    if (!this.file || !this.open || !this.forKinds.includes(frame.kind)) return;
    if (this.asking) {
      this.again = true;
      return;
    }
    const unclear = commaOf(this.at.value);
    if (unclear) {
      this.answered({ error: unclear });
      return;
    }
    this.asking = true;
    const sign = this.sign.checked ? '-1' : '1';
    const place = typed(this.at.value, 'm');
    const at = Number.isNaN(place) ? this.at.value.trim() : String(place);
    const query = new URLSearchParams({ at, kind: this.kind.value, sign });
    const { bodies, ...chosen } = frame.chosen;
    for (const [key, value] of entriesOf(bodies)) query.set(key, value);
    for (const name of names) if (name in chosen) query.set(name, String(chosen[name]));
    this.root.ariaBusy = 'true';
    waiter.soon('record', text('record.idle'));
    const answer = await this.#send(query, this.file);
    this.asking = false;
    this.root.ariaBusy = 'false';
    waiter.over('record');
    if (this.again) {
      this.again = false;
      this.ask();
    } else this.answered(answer);
  }
  /**
   * @param {URLSearchParams} query
   * @param {File} body
   * @returns {Promise<Compared | { error: string }>}
   */
  async #send(query, body) {
    const headers = { 'Content-Type': 'application/octet-stream' };
    try {
      const response = await fetch(served(`record?${query}`), { method: 'POST', body, headers });
      const answer = await response.json();
      return answer.error ? { error: said(answer.error) } : answer;
    } catch {
      return { error: text('record.not-sent', { most: LIMIT / 1e6 }) };
    }
  }
  /**
   * @param {Compared | { error: string }} answer
   */
  answered(answer) {
    const refusal = 'error' in answer ? answer.error : null;
    if (refusal !== this.refusal) this.wrong.textContent = refusal; // said once, not at every step of a slider
    this.refusal = refusal;
    this.answer = 'error' in answer ? null : answer;
    this.at.placeholder = localised(String(this.answer?.at ?? '–')); // as the file says it, where nothing is typed
    this.result.hidden = !this.answer;
    if (this.answer) {
      this.reset();
    } else {
      this.overlay();
      this.page.drawCharts();
    }
  }
  reset() {
    this.shift.value = this.scale.value = String(STEPS / 2);
    this.moved();
  }
  moved() {
    for (const slider of [this.shift, this.scale])
      slider.style.setProperty('--fill', `${(100 * Number(slider.value)) / STEPS}%`);
    this.overlay();
    if (this.answer) {
      this.#plot(this.answer);
      this.#tell(this.answer);
    }
    this.page.drawCharts();
    this.page.show(this.page.player.t);
  }
  // How far the record is moved beyond the automatic shift [T], and by what factor beyond the automatic scale.
  get later() {
    return LATER * ((2 * Number(this.shift.value)) / STEPS - 1);
  }
  get larger() {
    return LARGER ** ((2 * Number(this.scale.value)) / STEPS - 1);
  }
  // The recovered force on the page's own chart of the force, by the view that has one.
  overlay() {
    const { frame } = this.page;
    const { answer, later, larger } = this;
    if (!frame) return;
    let record = null;
    if (this.open && answer?.recovered) {
      const { time, force } = answer.recovered;
      record = { time: time.map((t) => (t + later) * answer.trip), force: force.map((f) => f * larger) };
    }
    this.page.views[frame.kind].overlay?.(frame, record);
  }
  /**
   * What was computed at t; nought before the impact, NaN where nothing is known.
   * @param {Compared} answer
   * @param {number} t
   */
  model({ computed: { time, model } }, t) {
    if (t > time[time.length - 1]) return NaN;
    return t < Math.min(time[0], 0) ? 0 : between(time, model, t);
  }
  /**
   * As on the server: the difference in the L2 norm, where the solution is known, over that of the solution.
   * @param {Compared} answer
   */
  remains(answer) {
    const { later, larger } = this;
    if (!later && larger === 1) return answer.residual;
    let difference = 0;
    let norm = 0;
    answer.time.forEach((t, k) => {
      const model = this.model(answer, t + later);
      if (!Number.isFinite(model)) return;
      norm += model ** 2;
      difference += (answer.values[k] * larger - model) ** 2;
    });
    return norm ? Math.sqrt(difference / norm) : NaN;
  }
  /** @param {Compared} answer */
  #plot(answer) {
    const { later, larger } = this;
    const [si, unit] = UNITS[answer.kind];
    const factor = factorOf(si, unit);
    const { time, model } = answer.computed;
    const values = answer.values.map((value) => (value * larger) / factor);
    const computed = model.map((value) => value / factor);
    const { kind } = answer;
    this.figure.fill('computed', { time, value: computed });
    this.figure.fill('measured', { time: answer.time.map((t) => t + later), value: values });
    const [low, high] = [Math.min(...computed, 0), Math.max(...computed, 0)];
    const room = 0.15 * (high - low) || 1;
    this.figure.range('record-x', [Math.min(-0.05, Math.max(answer.time[0], -0.5)), time[time.length - 1]]);
    this.figure.range('record-y', [low - room, high + room]);
    this.figure.set('record-up', { axis_label: text('record.axis', { kind, unit }) });
    this.figure.open().then(() => this.show(this.page.player.t));
  }
  #numbers() {
    const { answer, later, larger } = this;
    if (!answer) return [[]];
    const [si, unit] = UNITS[answer.kind];
    const factor = factorOf(si, unit);
    const last = answer.time.length - 1;
    const rows = Array.from({ length: ROWS }, (_, k) => Math.round((k / (ROWS - 1)) * last));
    return [
      [text('panel.time-in', { unit: 'T' }), text('record.measured', { unit }), text('record.computed', { unit })],
      ...rows.map((i) => {
        const t = answer.time[i] + later;
        const values = [answer.values[i] * larger, this.model(answer, t)];
        return [signed(t), ...values.map((value) => (Number.isFinite(value) ? figures(value / factor, 4) : '–'))];
      }),
    ];
  }
  /** @param {Compared} answer */
  #tell(answer) {
    const { later, larger } = this;
    const shift = answer.shift + later * answer.trip;
    const share = this.remains(answer);
    this.shiftSaid.textContent = `${signed(1e6 * shift, 2)} µs`;
    this.scaleSaid.textContent = `× ${localised((answer.scale * larger).toPrecision(4))}`;
    this.residual.textContent = Number.isFinite(share)
      ? text('record.residual', { share: localised((100 * share).toPrecision(3)) })
      : text('record.nothing');
    this.automatic.disabled = !later && larger === 1;
    const { kind } = answer;
    this.said.textContent = [
      text('record.residual-of', { kind }),
      ...('main' in this.page.frame ? [text('record.period', { period: duration(answer.trip) })] : []),
      ...(answer.recovered ? [text('record.drawn', { kind })] : []),
      ...answer.notes.map(said),
    ].join(' ');
  }
  draw() {}
  /** @param {number} t */
  show(t) {
    this.figure.cursor('record-cursor', t / this.unit);
  }
}

export const PANELS = { record: Measurement }; // by their names in the address
