// Where each integrator keeps the energy, chatters or fails: one small map each, over the step and one thing more.
import { share } from './advice.js';
import { figures } from './beam_stage.js';
import { decade, LogChart } from './logplot.js';
import { make, Panel } from './panel.js';
import { plainly } from './words.js';

const COLOURS = { ok: '#cfe6d2', slight: '#f5eeb8', error: '#f3c58a', chatter: '#b9d2ea', stopped: '#dfe4e9', lasting: '#b99bd0', failed: '#c64a52', none: '#ffffff' };
const WORDS = { ok: 'energy kept to 10⁻⁶', slight: 'to 1 %', error: 'wrong by more', chatter: 'chatters', stopped: 'stopped at its bound', lasting: 'never parts', failed: 'grows past reason' };

const AXES = { // in the list, below the maps, and of one value in words
  contact_stiffness: ['contact stiffness', 'contact stiffness ÷ an element’s, or the law’s', (v, law) => (law === 'rigid' ? `a contact ${v} times as stiff as an element` : `a contact ${v} times as stiff as its law`)],
  mass_ratio: ['mass ratio', 'mass ratio, target over impactor', (v) => `a target ${v} times as heavy as what strikes it`],
  modes: ['modes', 'modes kept', (v) => `${v} modes`],
  restitution: ['restitution', 'restitution that the contact delivers', (v) => `a restitution of ${v}`],
  speed: ['speed', 'speed of approach, m/s', (v) => `an approach at ${v} m/s`],
};
const ENDINGS = { stopped: 'stopped at its bound of', lasting: 'never parts, in', failed: 'grows past reason after' };
const ARROWS = { ArrowRight: [0, 1], ArrowLeft: [0, -1], ArrowUp: [1, 0], ArrowDown: [-1, 0] };

// Where the cells of these values begin and end.
function edges(values, log) {
  const between = (a, b) => (log ? Math.sqrt(a * b) : (a + b) / 2), beyond = (a, b) => (log ? a * a / b : 2 * a - b);
  const inner = values.slice(1).map((value, k) => between(values[k], value));
  return [beyond(values[0], inner[0]), ...inner, beyond(values.at(-1), inner.at(-1))];
}

class Small {
  constructor() {
    this.chart = new LogChart('', 'map of stability', ['', 'step × highest frequency, rad']);
    this.said = make('p', { className: 'help' }); // of all runs, or of the one that is pointed at
    this.said.setAttribute('aria-live', 'polite');
    this.root = make('div', { className: 'small-map' }, this.chart.root, this.said);
    const { area } = this.chart;
    area.tabIndex = 0;
    area.setAttribute('role', 'application');
    area.onpointermove = (event) => this.pick(this.under(event));
    area.onpointerleave = () => { if (!this.kept) this.pick(null); };
    area.onfocus = () => { this.kept = true; if (!this.cell) this.pick([0, 0]); };
    area.onblur = () => { this.kept = false; this.pick(null); };
    area.onkeydown = (event) => {
      const way = ARROWS[event.key];
      if (!way || !this.cell) return;
      event.preventDefault();
      this.pick(this.cell.map((at, k) => Math.min(Math.max(at + way[k], 0), this.edges[k].length - 2)));
    };
  }
  load(found, map) {
    Object.assign(this, { found, map, cell: null });
    const { chart } = this, { across } = found;
    this.edges = [edges(found.step, true), edges(across.values, across.log)];
    [chart.y, chart.x] = this.edges.map((each) => [each[0], each.at(-1)]);
    chart.linear = !across.log;
    chart.named[0] = AXES[across.name][1];
    chart.head.querySelector('h2').textContent = map.name === 'modal' ? `${map.label} (the page’s own)` : map.label;
    chart.area.setAttribute('aria-label', `${map.label} over step and ${AXES[across.name][0]}: arrow keys go from one run to the next`);
    const worst = map.worst === null ? '' : ` Energy error of the others at most ${map.worst > 1e-3 ? share(map.worst) : map.worst > 0 ? decade(Math.ceil(Math.log10(map.worst))) : 0}.`;
    this.whole = map.reason ?? `${map.failures ? `${map.failures} of ${map.count} runs fail` : `None of ${map.count} runs fails`}${map.chattering ? `, ${map.chattering} chatter` : ''}.${worst} Theory: ${plainly(map.limit_name)}.`;
    this.pick(null);
  }
  kind(i, j) { return this.found.kinds[Number(this.map.runs[i][j])]; }
  draw() {
    const { chart, found, map } = this;
    if (!map || !chart.fit()) return;
    const c = chart.begin(chart.below), [up, across] = this.edges;
    for (let i = 0; i + 1 < up.length; i++) for (let j = 0; j + 1 < across.length; j++) {
      c.fillStyle = COLOURS[this.kind(i, j)];
      c.fillRect(chart.px(across[j]), chart.py(up[i + 1]), chart.px(across[j + 1]) - chart.px(across[j]) + 0.6, chart.py(up[i]) - chart.py(up[i + 1]) + 0.6);
    }
    chart.axes(c);
    chart.clip(c);
    this.limit(c);
    c.restore();
    const inside = (v, [low, high]) => Math.min(Math.max(v, low), high), [step, here] = found.here;
    c.fillStyle = '#c81e4a';
    c.strokeStyle = '#fff';
    c.lineWidth = 1.5;
    c.beginPath(); c.arc(chart.px(inside(here, chart.x)), chart.py(inside(step, chart.y)), 4.5, 0, 7); c.fill(); c.stroke();
    this.mark();
  }
  // The largest stable step by theory.
  limit(c) {
    const { chart, found, map } = this;
    if (!map.limit) return;
    c.strokeStyle = '#1c2733';
    c.lineWidth = 2;
    c.beginPath();
    let pen = false;
    map.limit.forEach((step, j) => {
      if (step === null) { pen = false; return; }
      const x = chart.px(found.across.values[j]), y = chart.py(step);
      if (pen) c.lineTo(x, y); else c.moveTo(x, y);
      pen = true;
    });
    c.stroke();
  }
  // Row and column under a pointer, or null.
  under(event) {
    if (!this.map || !this.chart.box) return null;
    const [x, y] = this.chart.under(event), place = (values, at) => values.findIndex((edge, k) => edge <= at && at < values[k + 1]);
    const cell = [place(this.edges[0], y), place(this.edges[1], x)];
    return cell.includes(-1) ? null : cell;
  }
  pick(cell) {
    this.cell = cell;
    this.said.textContent = cell ? this.words(...cell) : this.whole;
    this.said.classList.toggle('cell', Boolean(cell));
    this.mark();
  }
  mark() {
    const { chart, cell } = this;
    if (!chart.box) return;
    const c = chart.begin(chart.above);
    if (!cell) return;
    const [i, j] = cell, [up, across] = this.edges, x = chart.px(across[j]), y = chart.py(up[i + 1]);
    c.strokeStyle = '#1c2733';
    c.lineWidth = 2;
    c.strokeRect(x, y, chart.px(across[j + 1]) - x, chart.py(up[i]) - y);
  }
  words(i, j) {
    const { found, map } = this, { across, step } = found, kind = this.kind(i, j), limit = map.limit?.[j] ?? null;
    const where = `A step of ${figures(step[i], 2)} rad and ${AXES[across.name][2](figures(across.values[j], 3), found.chosen.law)}: `;
    if (kind === 'none') return `${where}not run.`;
    const error = map.errors[i][j], chatter = map.chatter[i][j], ending = ENDINGS[kind], speed = map.velocities[i][j];
    const wrong = error === null ? '' : `, energy ${error === 0 ? 'exact' : `${error < 0 ? 'lost' : 'gained'} ${share(Math.abs(error))}`}`;
    const theory = limit === null ? '' : ` Theory allows ${figures(limit, 2)} rad.`;
    return `${where}${ending ?? 'parts after'} ${map.steps[i][j]} steps${ending ? '' : `, at ${figures(speed, 3)} of the speed`}${wrong}${chatter ? `, ${chatter} touches too many` : ''}.${theory}`;
  }
}

export class Stability extends Panel {
  constructor(page) {
    super(page, 'stability', 'Stability', 'where each integrator keeps the energy, chatters or fails', 'Where each integrator keeps the energy, chatters or fails', ['stability_axis']);
    this.axis = make('select', { ariaLabel: 'Step against' }, ...Object.entries(AXES).map(([value, [textContent]]) => make('option', { value, textContent })));
    this.axis.onchange = () => this.turn(this.axis.value);
    this.said = make('p', { className: 'help', role: 'status' });
    this.notes = make('ul', { className: 'help' });
    this.start = make('button', { type: 'button', className: 'whole', onclick: () => this.run() });
    this.bar = make('progress', { max: 1, value: 0, hidden: true, ariaLabel: 'Worked out so far' });
    this.key = make('p', { className: 'legend' });
    this.grid = make('div', { className: 'small-maps' });
    this.root.append(this.said, make('div', { className: 'record-form' }, make('label', { className: 'part' }, 'Step against', this.axis), this.start, this.bar), this.notes, this.key, this.grid);
    this.maps = [];
    page.model.on('stability_running', () => this.fill());
    this.key.replaceChildren(...Object.entries(WORDS).map(([kind, text]) => { const mark = make('i', { className: 'chip' }); mark.style.background = COLOURS[kind]; return make('span', { className: 'key' }, mark, text); }), make('span', { className: 'key' }, make('i', { className: 'line' }), 'largest stable step by theory'));
  }
  opened() { if (this.open && !this.known && !this.page.model.stability_running) this.run(); }
  run() {
    const { model } = this.page;
    model.stability_running = !model.stability_running;
    this.fill();
  }
  // What is under way is of the other axis: it is stopped, and begun anew.
  turn(axis) {
    const { model } = this.page;
    model.stability_axis = axis;
    model.stability_running = false;
    if (!this.start.disabled) model.stability_running = true;
    this.fill();
  }
  told(found) {
    this.axis.value = this.page.model.stability_axis;
    const running = this.page.model.stability_running, away = this.page.frame.kind === 'bodies';
    this.bar.hidden = !running;
    this.bar.value = found?.of ? found.done / found.of : 0;
    this.start.disabled = away && !running;
    this.start.textContent = running ? 'Cancel' : this.known || found?.maps ? 'Work it out again' : 'Work it out';
    if (found?.maps && found !== this.known && (this.fresh(found) || !found.cancelled)) { this.known = found; this.load(found); }
    const { known } = this, stale = known && !this.fresh(known);
    this.root.setAttribute('aria-busy', String(Boolean(stale)));
    this.said.textContent = running ? `Striking with steps from a hundredth to five periods, over the ${AXES[this.page.model.stability_axis][0]} …`
      : away ? 'Bodies in space have no step to choose: their blow takes no time.'
      : !known ? 'Nothing is worked out yet.'
      : stale ? 'These maps are of the choices before.' : `${known.cancelled ? 'Cancelled: what is white was not run. ' : ''}The dot is this scene at the page’s own step.`;
    this.notes.replaceChildren(...known && !stale && !running ? known.notes.map((note) => make('li', { textContent: plainly(this.names(known, note)) })) : []);
    this.key.hidden = this.grid.hidden = !known;
    this.draw();
  }
  // A sentence with the names that stand above the maps.
  names(found, note) {
    const said = note.replace('; raise most_steps to see the end', '').replace('Differs: thesis', 'Thesis');
    return found.maps.reduce((text, { name, label }) => text.replace(new RegExp(`(?<![\\w-])${name}(?=[,:])`, 'g'), label.split(',')[0] + (name === 'newmark-frozen' ? ', frozen' : '')), said);
  }
  load(found) {
    while (this.maps.length < found.maps.length) this.maps.push(new Small());
    this.grid.replaceChildren(...found.maps.map((map, k) => { this.maps[k].load(found, map); return this.maps[k].root; }));
  }
  draw() { if (!this.root.hidden && this.known) for (const map of this.maps) map.draw(); }
}
