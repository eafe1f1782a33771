// What this blow needs: the smallest adequate model for a question, and where the blow lies among all others.
import { figures } from './beam_stage.js';
import { decade, LogChart } from './logplot.js';

const make = (tag, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
};
export const share = (error) => (error === 0 ? 'nothing' : error < 5e-8 ? '< 10⁻⁵ %' : error > 10 ? '> 1000 %' : `${figures(100 * error, 2)} %`);

const QUESTIONS = { 'final-velocities': 'final velocities', 'peak-force': 'peak force', 'contact-times': 'first touch to last parting', stresses: 'largest stress inside' };
const MODELS = { 'rigid-impulse': 'rigid impulse', 'local-quasi-static': 'only the contact gives way', 'structural-quasi-static': 'the body bends as at rest', waves: 'travelling waves', modal: 'modes' };
const COLOURS = ['#cfe3f3', '#d6ead0', '#fbe3b6', '#f3cfc6'];
const GREY = '#eceff2', LEVELS = [[0.01, '#2e7d4f', '1 %'], [0.05, '#b7791f', '5 %'], [0.2, '#a4243b', '20 %']];
const FAMILIES = { 'fixed-rod': 'a rod fixed at its far end', 'free-rod': 'a free rod', cantilever: 'a cantilever', 'pinned-pinned': 'a beam pinned at both ends', 'clamped-clamped': 'a beam clamped at both ends', 'free-free': 'a free beam' };
const FINE = [220, 160], STRIP = 26, TRAIL = 40, AIM = 10 ** 0.1; // a step of the arrow keys
const inside = (value, [low, high]) => Math.min(Math.max(value, low), high);

// "modal, 5 modes, timoshenko" in the words of the page.
export function modelName(model) {
  const [first, ...rest] = model.split(', ');
  return [MODELS[first] ?? first, ...rest].join(', ').replace('modes, ', '').replace('timoshenko', 'Timoshenko').replace('euler-bernoulli', 'Euler–Bernoulli');
}

// Why, with the models named as in the table.
function reasonOf({ reason, candidates }) {
  const models = candidates.map(({ model }) => model).sort((a, b) => b.length - a.length);
  return models.reduce((text, model) => text.replace(new RegExp(`(?<![\\w“-])${model}(?= (?:is|would|leaves) )`, 'g'), `“${modelName(model)}”`), reason);
}

// Which of the classes of error: within 1, 5, 20 %, or worse.
const grade = (error) => LEVELS.findIndex(([level]) => error <= level);

// A number that the visitor gives in another unit than the one that is sent, which is so many times as large.
function unitField(label, unit, kind, times, low, high, send, complain) {
  const input = make('input', { type: 'text', inputMode: 'decimal', className: 'number', autocomplete: 'off', maxLength: 12 });
  input.setAttribute('aria-label', `${label}, in ${kind[1]}`);
  let last = '';
  input.onchange = () => {
    const text = input.value.trim().replace(',', '.').replace(unit, '').trim(), value = Number(text) / times;
    if (/^\d*\.?\d+(e[+-]?\d+)?$/i.test(text) && value >= low && value <= high) { send(value); return; }
    complain(`${label}: got '${input.value.slice(0, 24)}'; allowed: ${kind[0]} from ${figures(times * low)} to ${figures(times * high)}`);
    input.value = last;
  };
  const root = make('label', { className: 'part' }, label, input, make('span', { className: 'unit', textContent: unit }));
  return { root, input, set: (value) => { last = String(Number((times * value).toPrecision(4))); if (document.activeElement !== input && input.getRootNode().activeElement !== input) input.value = last; } };
}
export const percentField = (label, ...rest) => unitField(label, '%', ['a percentage', 'percent'], 100, ...rest);
export const msField = (label, ...rest) => unitField(label, 'ms', ['milliseconds', 'milliseconds'], 1000, ...rest);

// Choices of the page that show one model, all at once.
export function choose(page, choices) {
  const [first, ...rest] = Object.entries(choices);
  for (const [name, value] of rest) page.waiting[name] = value;
  page.send(...first);
}

class RegimeMap {
  constructor() {
    this.chart = new LogChart('Where cheap models hold', 'map of the error of cheap models over contact time and mass ratio', ['contact time by itself, in round trips', 'mass ratio, target over impactor']);
    this.chart.across = this.chart.upward = decade;
    this.shown = 'smallest';
    this.kinds = make('div', { className: 'segments small', role: 'group' });
    this.kinds.setAttribute('aria-label', 'The map shows');
    this.about = make('p', { className: 'help' });
    this.root = make('div', { className: 'regimes' }, this.kinds, this.chart.root, this.about);
    this.trail = [];
    this.image = make('canvas', { width: FINE[0], height: FINE[1] });
    this.listen();
  }
  // `go(text)` is given a place that is asked for, "time ratio".
  listen() {
    const { area, value } = this.chart, ask = (event) => this.ask(this.aimed(event));
    area.tabIndex = 0;
    area.setAttribute('role', 'application');
    area.setAttribute('aria-label', 'Map over contact time and mass ratio: arrow keys aim, Enter moves the sliders there');
    area.onpointermove = (event) => {
      value.textContent = this.at(...this.chart.under(event));
      if (this.dragged) ask(event);
    };
    area.onpointerleave = () => { value.textContent = ''; };
    area.onpointerdown = (event) => {
      if (event.pointerType === 'touch' || !(event.buttons & 1)) return; // a finger may want to scroll: it taps
      area.setPointerCapture(event.pointerId);
      this.dragged = true;
      ask(event);
    };
    area.onpointerup = area.onpointercancel = () => { this.dragged = false; };
    area.onclick = (event) => { if (event.pointerType === 'touch') ask(event); };
    area.onfocus = () => { if (!this.dragged && area.matches(':focus-visible')) this.aim(this.trail.at(-1)); };
    area.onblur = () => this.aim(null);
    area.onkeydown = (event) => this.key(event);
  }
  key(event) {
    const way = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key], { chart } = this;
    if (event.key === 'Enter' && this.target) this.ask(this.target);
    if (!way || !this.trail.length) return;
    event.preventDefault();
    let [time, ratio] = this.target ?? this.trail.at(-1);
    if (way[0]) time = time === 0 ? (way[0] > 0 ? chart.x[0] : 0) : way[0] < 0 && time <= chart.x[0] && chart.gap ? 0 : inside(time * AIM ** way[0], chart.x);
    ratio = inside(ratio * AIM ** way[1], chart.y);
    this.aim([time, ratio]);
  }
  // Contact time and mass ratio under a pointer; beside the map the contact is rigid.
  aimed(event) {
    const { chart } = this, [time, ratio, u] = chart.under(event);
    return [u < 0 && chart.gap ? 0 : inside(time, chart.x), inside(ratio, chart.y)];
  }
  aim(target) {
    this.target = target;
    if (target) this.chart.value.textContent = `aims at ratio ${figures(target[1], 2)}, ${target[0] === 0 ? 'rigid' : `time ${figures(target[0], 2)}`}`;
    this.mark();
  }
  ask(place) { if (this.map) this.go?.(place.map((value) => value.toPrecision(4)).join(' ')); }
  load(text) {
    if (text === this.text) return;
    this.text = text;
    this.map = text && text !== '{}' ? JSON.parse(text) : null;
    this.root.hidden = !this.map;
    this.trail = [];
    if (!this.map) return;
    const { map, chart } = this, beam = !map.family.endsWith('-rod'), rigid = map.time[0] === 0;
    chart.x = [map.time[rigid ? 1 : 0], map.time.at(-1)];
    chart.y = [map.ratio[0], map.ratio.at(-1)];
    chart.gap = rigid ? STRIP : 0;
    chart.margin.left = 52 + chart.gap;
    chart.named[0] = `contact time ÷ ${beam ? 'slowest period of the beam' : 'round trip of a wave'}`;
    this.kinds.replaceChildren(...['smallest', ...map.models].map((kind) => {
      const button = make('button', { type: 'button', textContent: kind === 'smallest' ? 'smallest that will do' : MODELS[kind], onclick: () => { this.shown = kind; this.paint(); } });
      button.dataset.kind = kind;
      return button;
    }));
  }
  // Errors of every model at a place given by the numbers of its row and column, straight in logarithms between them.
  errors(row, column) {
    const { map } = this, i = Math.min(Math.floor(row), map.ratio.length - 2), j = Math.min(Math.floor(column), map.time.length - 2), u = row - i, w = column - j;
    return map.errors.map((table) => {
      const corners = [table[i][j], table[i][j + 1], table[i + 1][j], table[i + 1][j + 1]];
      if (corners.includes(null)) return corners[(u > 0.5 ? 2 : 0) + (w > 0.5 ? 1 : 0)];
      const [a, b, c, d] = corners.map((v) => Math.log(Math.max(v, 1e-12)));
      return Math.exp((a * (1 - w) + b * w) * (1 - u) + (c * (1 - w) + d * w) * u);
    });
  }
  colour(errors) {
    if (this.shown === 'smallest') {
      const first = errors.findIndex((error) => error !== null && error <= this.tolerance);
      return COLOURS[first < 0 ? 3 : first];
    }
    const error = errors[this.map.models.indexOf(this.shown)], k = error === null ? -2 : grade(error);
    return k === -2 ? GREY : ['#d6ead0', '#fdf3cf', '#fbdcb6', '#f3cfc6'][k < 0 ? 3 : k];
  }
  paint() {
    const { map, chart } = this;
    if (!map) return;
    for (const button of this.kinds.children) button.setAttribute('aria-pressed', String(button.dataset.kind === this.shown));
    const [columns, rows] = FINE, context = this.image.getContext('2d'), start = map.time[0] === 0 ? 1 : 0;
    const place = (values, k, count) => { // the fractional number of an evenly spread place
      const reach = Math.log(values.at(-1) / values[0]), at = Math.exp(Math.log(values[0]) + reach * (k + 0.5) / count);
      let n = 0;
      while (n < values.length - 2 && values[n + 1] < at) n++;
      return n + Math.log(at / values[n]) / Math.log(values[n + 1] / values[n]);
    };
    const across = Array.from({ length: columns }, (_, k) => start + place(map.time.slice(start), k, columns));
    for (let row = 0; row < rows; row++) {
      const i = place(map.ratio, row, rows);
      for (let column = 0; column < columns; column++) {
        context.fillStyle = this.colour(this.errors(i, across[column]));
        context.fillRect(column, rows - 1 - row, 1, 1);
      }
    }
    this.legend();
    this.draw();
  }
  legend() {
    const { map } = this, swatch = (colour) => { const mark = make('i', { className: 'chip' }); mark.style.background = colour; return mark; };
    const line = (colour) => { const mark = make('i', { className: 'line' }); mark.style.color = colour; return mark; };
    const last = map.family.endsWith('-rod') ? 'waves' : 'modes';
    const entries = this.shown === 'smallest' ? [...map.models.map((name, k) => [swatch(COLOURS[k]), MODELS[name]]), [swatch(COLOURS[3]), `only ${last}`]]
      : [...LEVELS.map(([, colour, name]) => [line(colour), `misses ${name}`]), [swatch(GREY), 'does not tell']];
    this.chart.legend.replaceChildren(...entries.map(([mark, text]) => make('span', { className: 'key' }, mark, text)));
  }
  draw() {
    const { map, chart } = this;
    if (!map || !chart.fit()) return;
    const c = chart.begin(chart.below), { box } = chart;
    c.imageSmoothingEnabled = false;
    c.drawImage(this.image, box.x, box.y, box.w, box.h);
    if (map.time[0] === 0) this.strip(c);
    chart.axes(c);
    if (this.shown !== 'smallest') this.lines(c);
    this.mark();
  }
  // Rigid contacts lie at no place of a logarithmic axis: in a strip beside it.
  strip(c) {
    const { map, chart } = this, { box } = chart, n = map.ratio.length;
    for (let k = 0; k < 80; k++) {
      c.fillStyle = this.colour(map.errors.map((table) => table[Math.round((k + 0.5) / 80 * (n - 1))][0]));
      c.fillRect(box.x - STRIP, box.y + box.h * (79 - k) / 80, STRIP - 8, box.h / 80 + 0.6);
    }
    c.fillStyle = '#5b6c7d';
    c.font = '11px system-ui, sans-serif';
    c.textAlign = 'center';
    c.textBaseline = 'top';
    c.fillText('rigid', box.x - STRIP / 2 - 8, box.y + box.h + 5);
  }
  lines(c) {
    const { chart } = this;
    c.lineWidth = 2;
    for (const [level, times, ratios] of this.map.contours[this.shown]) {
      c.strokeStyle = LEVELS.find(([value]) => value === level)[1];
      c.beginPath();
      for (let k = 0; k + 1 < times.length; k++) if (times[k] !== null && times[k + 1] !== null) { c.moveTo(chart.px(times[k]), chart.py(ratios[k])); c.lineTo(chart.px(times[k + 1]), chart.py(ratios[k + 1])); }
      c.stroke();
    }
  }
  // The present scene, and where it came from.
  move(groups) {
    const last = this.trail.at(-1), next = [groups.contact_time, groups.mass_ratio];
    if (last && last[0] === next[0] && last[1] === next[1]) return;
    this.trail.push(next);
    if (this.trail.length > TRAIL) this.trail.shift();
  }
  placed([time, ratio]) {
    const { chart } = this, { box } = chart;
    const x = time === 0 && chart.gap ? box.x - STRIP / 2 - 4 : chart.px(inside(time, chart.x));
    return [x, chart.py(inside(ratio, chart.y))];
  }
  mark() {
    const { chart } = this;
    if (!chart.box || !this.trail.length) return;
    const c = chart.begin(chart.above), here = this.placed(this.trail.at(-1));
    c.strokeStyle = 'rgba(200,30,74,.35)';
    c.lineWidth = 2;
    c.beginPath();
    this.trail.forEach((each, k) => { const [x, y] = this.placed(each); if (k) c.lineTo(x, y); else c.moveTo(x, y); });
    c.stroke();
    c.fillStyle = '#c81e4a';
    c.strokeStyle = '#fff';
    c.lineWidth = 2;
    c.beginPath(); c.arc(...here, 6.5, 0, 7); c.fill(); c.stroke();
    if (!this.target) return;
    const [x, y] = this.placed(this.target);
    c.strokeStyle = '#1c2733';
    c.beginPath(); c.moveTo(x - 10, y); c.lineTo(x + 10, y); c.moveTo(x, y - 10); c.lineTo(x, y + 10); c.stroke();
  }
  at(time, ratio, u, w) {
    const { map } = this;
    if (!map || u < 0 || u > 1 || w < 0 || w > 1) return '';
    const row = (values, at) => { let n = 0; while (n < values.length - 2 && values[n + 1] < at) n++; return n + Math.log(at / values[n]) / Math.log(values[n + 1] / values[n]); };
    const start = map.time[0] === 0 ? 1 : 0, errors = this.errors(row(map.ratio, ratio), start + row(map.time.slice(start), time));
    const told = map.models.map((name, k) => `${MODELS[name]} ${errors[k] === null ? '–' : share(errors[k])}`);
    return `ratio ${figures(ratio, 2)}, time ${figures(time, 2)}: ${told.join(', ')}`;
  }
}

export class Needs {
  constructor(page) {
    this.page = page;
    this.button = make('button', { type: 'button', textContent: 'What this blow needs', title: 'the smallest model that answers your question, and where cheap models fail', onclick: () => this.toggle() });
    this.question = make('select', { ariaLabel: 'Question' }, ...Object.entries(QUESTIONS).map(([value, textContent]) => make('option', { value, textContent })));
    this.question.onchange = () => this.ask('question', this.question.value);
    this.tolerance = percentField('Allowed error', 1e-4, 0.5, (value) => this.ask('plan_tolerance', value), (sentence) => page.complain(sentence));
    this.said = make('p', { className: 'verdict' });
    this.reason = make('p', { className: 'help' });
    this.table = make('table', { className: 'methods plan' });
    this.map = new RegimeMap();
    this.map.go = (point) => { this.point = point; this.go(); };
    page.model.on('map_point', () => this.go());
    const form = make('div', { className: 'record-form' }, make('label', { className: 'part' }, 'I want to know', this.question), this.tolerance.root);
    const left = make('div', { className: 'plan-told' }, form, this.said, make('div', { className: 'scroll' }, this.table), this.reason);
    this.root = make('section', { className: 'analysis needs', hidden: true }, make('h2', { textContent: 'What this blow needs' }), make('div', { className: 'sides' }, left, this.map.root));
    for (const name of ['plan', 'regimes', 'question', 'plan_tolerance']) page.model.on(name, () => this.fill());
  }
  get open() { return this.page.model.plan_shown; }
  toggle() {
    this.page.model.plan_shown = !this.open;
    this.take(this.page.frame);
    if (this.open) this.root.scrollIntoView({ behavior: 'smooth', block: 'nearest' });
  }
  ask(name, value) {
    this.page.model[name] = value;
    this.fill();
  }
  // The newest place that was asked for on the map, when the server is done with the one before.
  go() {
    const { model } = this.page;
    if (model.map_point || !this.point) return;
    const { point } = this;
    this.point = null;
    model.map_point = point;
  }
  take() {
    this.button.setAttribute('aria-pressed', String(this.open));
    this.root.hidden = !this.open;
    this.fill();
  }
  fill() {
    if (this.root.hidden) return;
    const { page } = this, { model } = page, found = model.plan ? JSON.parse(model.plan) : null;
    this.question.value = model.question;
    this.tolerance.set(model.plan_tolerance);
    const fresh = found && found.chosen.question === model.question && found.chosen.plan_tolerance === model.plan_tolerance && page.names.every((key) => found.chosen[key] === page.frame.chosen[key]);
    this.root.setAttribute('aria-busy', String(!fresh));
    if (!found) { this.said.textContent = 'Looking it up …'; return; }
    if (!fresh) return; // what is shown stays until the answer comes
    if (found.error) this.fail(found.error);
    else this.tell(found);
  }
  fail(sentence) {
    this.said.textContent = sentence;
    this.reason.textContent = '';
    this.table.replaceChildren();
    this.map.load('');
  }
  tell(found) {
    const { candidates, picked } = found, best = candidates[picked], within = best.error !== null && best.error <= found.chosen.plan_tolerance;
    const expected = best.error === null ? 'by how much it misses nobody has measured' : best.error === 0 ? 'which leaves out nothing' : `expected to miss ${share(best.error)}`;
    this.said.replaceChildren(within ? 'Enough: ' : 'The best there is: ', make('b', { textContent: modelName(best.model) }), `, ${expected}.`);
    this.reason.textContent = reasonOf(found);
    const head = make('thead', {}, make('tr', {}, ...['Model, from the smallest up', 'misses', ''].map((textContent) => make('th', { scope: 'col', textContent }))));
    this.table.replaceChildren(head, make('tbody', {}, ...candidates.map((candidate, k) => this.row(candidate, k === picked))));
    const drawn = this.map.shown, { map, tolerance } = this.map;
    this.map.load(this.page.model.regimes);
    this.map.tolerance = found.chosen.plan_tolerance;
    if (this.map.map) {
      this.map.move(found.groups);
      this.map.about.textContent = `A compact body strikes ${FAMILIES[this.map.map.family]}${this.map.map.law === 'hertz' ? ', Hertzian contact' : ''}; the dot is this scene, with the time that its contact would last between rigid bodies${found.measured ? '' : '; it lies outside what was measured'}. Each point of the map was solved by the cheap model and in full; error in the ${QUESTIONS[this.map.map.question]}. Click or drag to move the sliders there.`;
    }
    if (map !== this.map.map || tolerance !== this.map.tolerance || drawn !== this.map.shown) this.map.paint();
    else this.map.mark();
  }
  row(candidate, picked) {
    const { page } = this, missed = candidate.error === null ? (candidate.unknown ? 'not measured' : 'does not tell') : share(candidate.error);
    const { choices } = candidate, chosen = page.frame.chosen, here = choices && Object.entries(choices).every(([name, value]) => chosen[name] === value);
    const refused = choices && page.frame.refusals?.[choices.method], shown = make('button', { type: 'button', className: 'when', textContent: here ? 'shown' : 'show it', disabled: here, onclick: () => choose(page, choices) });
    const line = make('tr', {}, make('td', { textContent: modelName(candidate.model) }), make('td', { textContent: missed }), make('td', {}, ...(choices && !refused ? [shown] : [])));
    if (refused) line.lastChild.append(make('small', { textContent: 'not on this page' }));
    if (picked) line.setAttribute('aria-current', 'true');
    return line;
  }
  show() {}
  draw() { if (!this.root.hidden) this.map.draw(); }
}
