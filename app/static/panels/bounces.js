// A dropped body: its height over time, bounce after bounce, what each gives back, and when it rests.
import { Chart } from '../charts/chart.js';
import { headOf, make, rowOf, scrolled } from '../browser/dom.js';
import { SECONDS } from '../clock/times.js';
import { family, said, text } from '../text/catalogue.js';
import { duration, figures, length } from '../text/format.js';
import { Panel } from './panel.js';
import { Stopper } from './stopper.js';
import { unitField } from './unit_field.js';

/** @import { Page } from '../page.js' */
/** @import { Note } from '../text/catalogue.js' */

/**
 * @typedef {object} Bounce  in SI units
 * @property {number} time
 * @property {number} speed
 * @property {number} rebound
 * @property {number} restitution
 * @property {number} height
 * @property {number | null} contact_time
 */
/**
 * @typedef {object} Found
 * @property {Record<string, any>} chosen
 * @property {Note} [error]
 * @property {number} height
 * @property {number} gravity
 * @property {number} cut
 * @property {'cut' | 'contact' | 'stays' | 'count'} ended
 * @property {number | null} rest_time  [s]
 * @property {number | null} path  [m]
 * @property {Bounce[]} bounces
 * @property {number[]} path_time  [s]
 * @property {number[]} path_height  [m]
 * @property {string} method
 * @property {boolean} stopped
 * @property {Note[]} notes
 */

const LISTED = 12; // bounces of the table: the first ones, and the last
const HEIGHTS = /** @type {const} */ ([1e-6, 1e4]); // [m] that can be typed
const GRAVITIES = /** @type {const} */ ([0.01, 1e3]); // [m/s2]

class Bounces extends Panel {
  /** @type {Found | null} */ drawn = null;

  /** @param {Page} page */
  constructor(page) {
    super(page, 'bounces', text('bounces.button'), text('bounces.title'), text('bounces.heading'), ['bounce_gravity']);
    const [metres, acceleration] = [text('bounces.metres'), text('bounces.acceleration')];
    this.height = unitField(text('bounces.height'), { sign: 'm', many: metres }, ...HEIGHTS, (height) =>
      this.#drop(height, page.model.bounce_gravity),
    );
    this.gravity = unitField(text('bounces.gravity'), { sign: 'm/s²', many: acceleration }, ...GRAVITIES, (gravity) =>
      this.#pull(gravity),
    );
    this.stopper = new Stopper(page.model, 'bounces_running', () => this.fill());
    const form = make('div', { className: 'record-form' }, this.height.root, this.gravity.root, this.stopper.root);
    this.said = make('p', { className: 'verdict', role: 'status' });
    this.notes = make('ul', { className: 'help' });
    const title = (/** @type {string} */ name) => text(`bounces.chart.${name}`);
    this.path = new Chart({
      ...{ title: title('path'), about: title('path-about'), xUnit: SECONDS, unit: 'm' },
      ...{ zero: true, pad: [0, 0.08] },
    });
    this.each = new Chart({
      ...{ title: title('restitution'), about: title('restitution-about'), xName: title('speed') },
      ...{ xUnit: 'm/s', unit: '', y: [0, 1.05], points: true },
    });
    this.table = make('table', { className: 'methods' });
    this.result = make('div', {}, this.path.root, this.each.root, scrolled(this.table, text('bounces.heading')));
    this.root.append(form, this.said, this.notes, this.result);
  }
  /** Whether nothing bounces here: what is struck moves away, or what strikes is no single body. */
  get #moves() {
    const { frame } = this.page;
    const struck = 'beam' in frame ? frame.beam : 'target' in frame ? frame.target : null;
    return !struck?.held || ('impactor' in frame && ['rod', 'pulse'].includes(frame.impactor.kind));
  }
  get away() {
    return super.away || this.#moves;
  }
  take() {
    super.take();
    this.button.hidden = super.away;
    this.button.disabled = this.away;
    this.button.title = text(this.away ? 'bounces.refused' : 'bounces.title');
    this.button.ariaPressed = String(this.open && !this.away);
  }
  /**
   * To drop it from a height is to strike with the speed that the fall gives.
   * @param {number} height  [m]
   * @param {number} gravity  [m/s2]
   */
  #drop(height, gravity) {
    this.page.choose('speed', Math.sqrt(2 * gravity * height));
  }
  /** @param {number} gravity  from the same height [m/s2] */
  #pull(gravity) {
    const height = this.#height();
    this.page.model.bounce_gravity = gravity;
    this.#drop(height, gravity);
    this.fill();
  }
  #height() {
    const { speed } = /** @type {{ speed: number }} */ (this.page.frame.chosen);
    return speed ** 2 / (2 * this.page.model.bounce_gravity);
  }
  /**
   * @param {Found | null} found
   * @param {boolean} fresh
   */
  render(found, fresh) {
    this.gravity.set(this.page.model.bounce_gravity);
    this.height.set(this.#height());
    this.root.ariaBusy = String(!fresh);
    this.stopper.show(fresh && found && !found.error ? found.stopped : this.stopper.left);
    this.result.hidden = !found || Boolean(found.error);
    if (!found || !fresh) {
      if (this.stopper.left) this.said.textContent = text('bounces.stopped');
      else if (!found) this.said.textContent = text('bounces.idle');
      return;
    }
    this.notes.replaceChildren();
    if (found.error) this.said.textContent = said(found.error);
    else this.#tell(found);
    this.draw();
  }
  /** @param {Found} found */
  #tell(found) {
    this.drawn = found;
    const { bounces, cut, ended, height, path, rest_time: time, stopped } = found;
    const count = bounces.length;
    const words = [
      text('bounces.falls', { height, speed: bounces[0].speed }) +
        text('bounces.solved', { count, cut, ended, height: bounces[0].height }),
    ];
    if (ended === 'stays') words.push(text('bounces.stays'));
    if (time === null || path === null)
      words.push(text('bounces.restless', { stopped, height: bounces[count - 1].height }));
    else words.push(text('bounces.rest', { series: ended !== 'stays', time, path }));
    this.said.textContent = words.join(' ');
    const notes = [...found.notes.filter(({ code }) => code !== 'bounces-go-on').map(said)];
    notes.push(text('bounces.method', { method: found.method }));
    this.notes.replaceChildren(...notes.map((textContent) => make('li', { textContent })));
    this.#curves(found);
    this.#rows(found);
  }
  /** @param {Found} found */
  #curves({ bounces, path_height: y, path_time: x, rest_time: rest }) {
    this.path.axis.load(0, rest ?? x[x.length - 1]);
    this.path.show({ series: [{ x, y, name: text('bounces.chart.line'), style: 'exact' }] });
    const speeds = bounces.map(({ speed }) => speed);
    this.each.axis.load(0, 1.05 * Math.max(...speeds));
    const given = bounces.map(({ restitution }) => Math.max(restitution, 0));
    const order = speeds.map((_, k) => k).sort((a, b) => speeds[a] - speeds[b]);
    const [across, up] = [order.map((k) => speeds[k]), order.map((k) => given[k])];
    this.each.show({ series: [{ x: across, y: up, name: text('bounces.chart.each'), style: 'mode' }] });
  }
  /** @param {Found} found */
  #rows({ bounces, height }) {
    const columns = family('bounces.column');
    const shown = bounces.map((_, k) => k).filter((k) => k < LISTED - 1 || k === bounces.length - 1);
    const rows = shown.map((k) => {
      const { contact_time: contact, height: rises, rebound, restitution, speed, time } = bounces[k];
      const motion = [k + 1, figures(time, 4), figures(speed, 4), figures(Math.max(rebound, 0), 4)];
      const kept = [figures(restitution, 4), length(rises), figures((100 * rises) / height)];
      return rowOf([...motion, ...kept, contact === null ? '–' : duration(contact)]);
    });
    const left = bounces.length - shown.length;
    const more = make('td', { colSpan: 8, textContent: text('beam.table.more', { count: left }) });
    if (left) rows.splice(-1, 0, make('tr', {}, more));
    this.table.replaceChildren(headOf(Object.values(columns)), make('tbody', {}, ...rows));
  }
  draw() {
    if (this.root.hidden || this.result.hidden || !this.drawn) return;
    this.path.draw();
    this.each.draw();
  }
}

export const PANELS = { bounces: Bounces }; // by their names in the address
