// The map of where cheap models hold, over contact time and mass ratio; the scene is a dot on it.
import { contextOf, letters, scale } from '../charts/canvas.js';
import { LogChart } from '../charts/log_chart.js';
import { within } from '../charts/scale.js';
import { make, segments } from '../browser/dom.js';
import { family, text } from '../text/catalogue.js';
import { figures, share } from '../text/format.js';

/** @typedef {[time: number, ratio: number]} Place */
/** @typedef {(number | null)[]} Errors  null where a model cannot predict it */

/**
 * @typedef {object} Regimes
 * @property {string} family
 * @property {string} beyond  the model where none of them is good enough
 * @property {string} law
 * @property {string} question
 * @property {number[]} time  ascending; nought, for rigid contact, first
 * @property {number[]} ratio
 * @property {string[]} models
 * @property {(number | null)[][][]} errors  (model, ratio, time)
 * @property {Record<string, [level: number, times: (number | null)[], ratios: (number | null)[]][]>} contours
 */

const MODELS = family('name.model');
const COLOURS = ['#cfe3f3', '#d6ead0', '#fbe3b6', '#f3cfc6']; // of the models, and of what none of them can do
const GREY = '#eceff2';
/** @type {[level: number, colour: string, name: string][]} */
const LEVELS = [
  [0.01, '#2e7d4f', '1 %'],
  [0.05, '#b7791f', '5 %'],
  [0.2, '#a4243b', '20 %'],
];
const GRADES = ['#d6ead0', '#fdf3cf', '#fbdcb6', '#f3cfc6']; // up to each of them, and beyond
const FINE = [220, 160];
const STRIP = 26 * scale; // pixels of rigid contacts, which have no place on a logarithmic axis
const TRAIL = 40;
const AIM = 10 ** 0.1; // a step of the arrow keys
/** @type {Record<string, [across: number, up: number]>} */
const ARROWS = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/**
 * Where a value lies among ascending ones, as the number of the one below and a share of the way up, in logarithms.
 * @param {number[]} values
 * @param {number} at
 */
function rankOf(values, at) {
  let n = 0;
  while (n < values.length - 2 && values[n + 1] < at) n++;
  return n + Math.log(at / values[n]) / Math.log(values[n + 1] / values[n]);
}

/**
 * A sign in the legend.
 * @param {string} className
 * @param {string} colour
 */
function sign(className, colour) {
  const made = make('i', { className });
  if (className === 'chip') made.style.background = colour;
  else made.style.color = colour;
  return made;
}

export class RegimeMap {
  shown = 'smallest'; // or one of the models
  tolerance = 0;
  dragged = false;
  /** @type {Place[]} */ trail = []; // of the scene
  /** @type {Place | null} */ target = null; // that the keys aim at
  /** @type {string | undefined} */ known; // the answer as it came
  /** @type {Regimes | null} */ map = null;

  /** @param {(point: string) => void} go  is given a place that is asked for, "time ratio" */
  constructor(go) {
    this.go = go;
    this.chart = new LogChart(text('map.title'), text('map.described'), [text('map.across'), text('map.upward')]);
    this.kinds = segments(text('map.shows'), [], () => {});
    this.about = make('p', { className: 'help' });
    this.root = make('div', { className: 'regimes' }, this.kinds.root, this.chart.root, this.about);
    this.image = make('canvas', { width: FINE[0], height: FINE[1] });
    this.listen();
  }
  listen() {
    const { area, value } = this.chart;
    const ask = (/** @type {PointerEvent} */ event) => this.ask(this.aimed(event));
    area.tabIndex = 0;
    area.role = 'application';
    area.ariaLabel = text('map.keys');
    area.onpointermove = (event) => {
      value.textContent = this.at(...this.chart.under(event));
      if (this.dragged) ask(event);
    };
    area.onpointerleave = () => {
      value.textContent = '';
    };
    area.onpointerdown = (event) => {
      if (event.pointerType === 'touch' || !(event.buttons & 1)) return; // a finger may want to scroll: it taps
      area.setPointerCapture(event.pointerId);
      this.dragged = true;
      ask(event);
    };
    area.onpointerup = area.onpointercancel = () => {
      this.dragged = false;
    };
    area.onclick = (event) => {
      if (event instanceof PointerEvent && event.pointerType === 'touch') ask(event);
    };
    area.onfocus = () => {
      if (!this.dragged && area.matches(':focus-visible')) this.aim(this.trail.at(-1) ?? null);
    };
    area.onblur = () => this.aim(null);
    area.onkeydown = (event) => this.key(event);
  }
  /** @param {KeyboardEvent} event */
  key(event) {
    const way = ARROWS[event.key];
    const { chart } = this;
    const from = this.target ?? this.trail.at(-1);
    if (event.key === 'Enter' && this.target) this.ask(this.target);
    if (!way || !from) return;
    event.preventDefault();
    this.aim([this.#beside(from[0], way[0]), within(from[1] * AIM ** way[1], chart.y)]);
  }
  /**
   * One step across from a contact time; rigid contact lies before the first.
   * @param {number} time
   * @param {number} way
   */
  #beside(time, way) {
    const { x, gap } = this.chart;
    if (!way) return time;
    if (time === 0) return way > 0 ? x[0] : 0;
    return way < 0 && time <= x[0] && gap ? 0 : within(time * AIM ** way, x);
  }
  /**
   * Contact time and mass ratio under a pointer; beside the map the contact is rigid.
   * @param {PointerEvent} event
   * @returns {Place}
   */
  aimed(event) {
    const { chart } = this;
    const [time, ratio, u] = chart.under(event);
    return [u < 0 && chart.gap ? 0 : within(time, chart.x), within(ratio, chart.y)];
  }
  /** @param {Place | null} target */
  aim(target) {
    this.target = target;
    if (target) {
      const [time, ratio] = target;
      const place = { rigid: time === 0, time: figures(time, 2), ratio: figures(ratio, 2) };
      this.chart.value.textContent = text('map.aim', place);
    }
    this.mark();
  }
  /** @param {Place} place */
  ask(place) {
    if (this.map) this.go(place.map((value) => value.toPrecision(4)).join(' '));
  }
  /** @param {string} answer */
  load(answer) {
    if (answer === this.known) return;
    this.known = answer;
    /** @type {Regimes | null} */
    const map = answer && answer !== '{}' ? JSON.parse(answer) : null;
    this.map = map;
    this.root.hidden = !map;
    this.trail = [];
    if (!map) return;
    const { chart } = this;
    const beam = !map.family.endsWith('-rod');
    const rigid = map.time[0] === 0;
    chart.x = [map.time[rigid ? 1 : 0], map.time[map.time.length - 1]];
    chart.y = [map.ratio[0], map.ratio[map.ratio.length - 1]];
    chart.gap = rigid ? STRIP : 0;
    chart.margin.left = 52 * scale + chart.gap;
    chart.named[0] = text('map.across-of', { beam });
    const press = (/** @type {string} */ kind) => {
      this.shown = kind;
      this.paint();
    };
    const written = (/** @type {string} */ kind) => MODELS[kind] ?? text('map.smallest');
    const { root } = this.kinds;
    this.kinds = segments(text('map.shows'), ['smallest', ...map.models], press, written);
    this.kinds.root.classList.add('small');
    root.replaceWith(this.kinds.root);
  }
  /**
   * Errors of every model at a place given by the numbers of its row and column, straight in logarithms between them.
   * @param {Regimes} map
   * @param {number} row
   * @param {number} column
   * @returns {Errors}
   */
  errors(map, row, column) {
    const i = Math.min(Math.floor(row), map.ratio.length - 2);
    const j = Math.min(Math.floor(column), map.time.length - 2);
    const u = row - i;
    const w = column - j;
    return map.errors.map((table) => {
      const corners = [table[i][j], table[i][j + 1], table[i + 1][j], table[i + 1][j + 1]];
      if (corners.includes(null)) return corners[(u > 0.5 ? 2 : 0) + (w > 0.5 ? 1 : 0)];
      const [a, b, c, d] = corners.map((v) => Math.log(Math.max(Number(v), 1e-12)));
      return Math.exp((a * (1 - w) + b * w) * (1 - u) + (c * (1 - w) + d * w) * u);
    });
  }
  /**
   * @param {Regimes} map
   * @param {Errors} errors
   */
  colour(map, errors) {
    if (this.shown === 'smallest') {
      const first = errors.findIndex((error) => error !== null && error <= this.tolerance);
      return COLOURS[first < 0 ? 3 : first];
    }
    const error = errors[map.models.indexOf(this.shown)];
    if (error === null) return GREY;
    const grade = LEVELS.findIndex(([level]) => error <= level);
    return GRADES[grade < 0 ? 3 : grade];
  }
  paint() {
    const { map, image, shown } = this;
    if (!map) return;
    this.kinds.show(shown);
    const [columns, rows] = FINE;
    const context = contextOf(image);
    const start = map.time[0] === 0 ? 1 : 0;
    const times = map.time.slice(start);
    const spread = (/** @type {number[]} */ values, /** @type {number} */ way) =>
      rankOf(values, values[0] * (values[values.length - 1] / values[0]) ** way);
    const across = Array.from({ length: columns }, (_, k) => start + spread(times, (k + 0.5) / columns));
    for (let row = 0; row < rows; row++) {
      const i = spread(map.ratio, (row + 0.5) / rows);
      for (let column = 0; column < columns; column++) {
        context.fillStyle = this.colour(map, this.errors(map, i, across[column]));
        context.fillRect(column, rows - 1 - row, 1, 1);
      }
    }
    this.legend(map);
    this.draw();
  }
  /** @param {Regimes} map */
  legend(map) {
    /** @type {[HTMLElement, string][]} */
    const smallest = map.models.map((name, k) => [sign('chip', COLOURS[k]), MODELS[name]]);
    /** @type {[HTMLElement, string][]} */
    const missed = LEVELS.map(([, colour, name]) => [sign('line', colour), text('map.error', { error: name })]);
    if (this.shown === 'smallest')
      smallest.push([sign('chip', COLOURS[3]), text('map.only', { model: MODELS[map.beyond] })]);
    else missed.push([sign('chip', GREY), text('map.cannot')]);
    const entries = this.shown === 'smallest' ? smallest : missed;
    this.chart.legend.replaceChildren(...entries.map((entry) => make('span', { className: 'key' }, ...entry)));
  }
  draw() {
    const { map, chart } = this;
    if (!map || !chart.fit()) return;
    const c = chart.begin(chart.below);
    const { x, y, w, h } = chart.frame;
    c.imageSmoothingEnabled = false;
    c.drawImage(this.image, x, y, w, h);
    if (map.time[0] === 0) this.strip(c, map);
    chart.axes(c);
    if (this.shown !== 'smallest') this.lines(c, map);
    this.mark();
  }
  /**
   * Rigid contacts lie at no place of a logarithmic axis: in a strip beside it.
   * @param {CanvasRenderingContext2D} c
   * @param {Regimes} map
   */
  strip(c, map) {
    const box = this.chart.frame;
    const n = map.ratio.length;
    for (let k = 0; k < 80; k++) {
      c.fillStyle = this.colour(
        map,
        map.errors.map((table) => table[Math.round(((k + 0.5) / 80) * (n - 1))][0]),
      );
      c.fillRect(box.x - STRIP, box.y + (box.h * (79 - k)) / 80, STRIP - 8, box.h / 80 + 0.6);
    }
    c.fillStyle = '#5b6c7d';
    c.font = letters(13);
    c.textAlign = 'center';
    c.textBaseline = 'top';
    c.fillText(text('map.rigid'), box.x - STRIP / 2 - 8, box.y + box.h + 5);
  }
  /**
   * @param {CanvasRenderingContext2D} c
   * @param {Regimes} map
   */
  lines(c, map) {
    const { chart } = this;
    c.lineWidth = 2;
    for (const [level, times, ratios] of map.contours[this.shown]) {
      c.strokeStyle = LEVELS.find(([value]) => value === level)?.[1] ?? COLOURS[0];
      c.beginPath();
      let pen = false;
      times.forEach((time, k) => {
        const ratio = ratios[k];
        if (time === null || ratio === null) pen = false;
        else {
          if (pen) c.lineTo(chart.px(time), chart.py(ratio));
          else c.moveTo(chart.px(time), chart.py(ratio));
          pen = true;
        }
      });
      c.stroke();
    }
  }
  /**
   * The present scene, and where it came from.
   * @param {{ contact_time?: number, mass_ratio?: number }} groups
   */
  move({ contact_time: time, mass_ratio: ratio }) {
    if (time === undefined || ratio === undefined) return;
    const last = this.trail.at(-1);
    /** @type {Place} */
    const next = [time, ratio];
    if (last && last[0] === next[0] && last[1] === next[1]) return;
    this.trail.push(next);
    if (this.trail.length > TRAIL) this.trail.shift();
  }
  /**
   * @param {Place} place
   * @returns {[left: number, top: number]}
   */
  placed([time, ratio]) {
    const { chart } = this;
    const x = time === 0 && chart.gap ? chart.frame.x - STRIP / 2 - 4 : chart.px(within(time, chart.x));
    return [x, chart.py(within(ratio, chart.y))];
  }
  mark() {
    const { chart } = this;
    const last = this.trail.at(-1);
    if (!chart.box || !last) return;
    const c = chart.begin(chart.above);
    const here = this.placed(last);
    c.strokeStyle = 'rgba(200,30,74,.35)';
    c.lineWidth = 2;
    c.beginPath();
    this.trail.forEach((each, k) => {
      const [x, y] = this.placed(each);
      if (k) c.lineTo(x, y);
      else c.moveTo(x, y);
    });
    c.stroke();
    c.fillStyle = '#c81e4a';
    c.strokeStyle = '#fff';
    c.lineWidth = 2;
    c.beginPath();
    c.arc(...here, 6.5, 0, 7);
    c.fill();
    c.stroke();
    if (!this.target) return;
    const [x, y] = this.placed(this.target);
    c.strokeStyle = '#1c2733';
    c.beginPath();
    c.moveTo(x - 10, y);
    c.lineTo(x + 10, y);
    c.moveTo(x, y - 10);
    c.lineTo(x, y + 10);
    c.stroke();
  }
  /**
   * @param {number} time
   * @param {number} ratio
   * @param {number} u
   * @param {number} w
   */
  at(time, ratio, u, w) {
    const { map } = this;
    if (!map || u < 0 || u > 1 || w < 0 || w > 1) return '';
    const start = map.time[0] === 0 ? 1 : 0;
    const errors = this.errors(map, rankOf(map.ratio, ratio), start + rankOf(map.time.slice(start), time));
    const missed = errors.map((error) => (error === null ? '–' : share(error)));
    const listed = map.models.map((name, k) => `${MODELS[name]} ${missed[k]}`);
    return text('map.at', { ratio: figures(ratio, 2), time: figures(time, 2), errors: listed.join(', ') });
  }
}
