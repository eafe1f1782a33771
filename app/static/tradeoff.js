// Speed against accuracy: wall time and error of every method from coarse to fine; the best of them are joined.
import { share } from './advice.js';
import { figures } from './beam_stage.js';
import { naming } from './charts.js';
import { LogChart, percentDecade } from './logplot.js';
import { make, Panel, QUANTITIES, showMethod, shown } from './panel.js';
import { described, plainly } from './words.js';

const COLOURS = { waves: '#0b4f8a', modal: '#d9730d', 'mode-switch': '#a4243b', 'fe-nodal': '#2e7d4f', 'fe-modal': '#7c9a54', 'quasi-static': '#7a5ea8', balance: '#b08900', rigid: '#6b7785' };
const NEAR = 16, LEAST = 1e-12, LEFT = 200;
const ms = (seconds) => `${figures(1e3 * seconds, 3)} ms`;
const signed = (error) => (error === null ? 'does not tell' : error === 0 ? 'none' : `${error < 0 ? '−' : ''}${share(Math.abs(error))}`);

export class TradeOff extends Panel {
  constructor(page) {
    super(page, 'tradeoff', 'Speed or accuracy', 'what each method costs at each resolution, and what it misses', 'Speed or accuracy: what each method costs, and what it misses');
    this.quantity = 'peak-force';
    this.kinds = make('div', { className: 'segments small', role: 'group' }, ...Object.entries(QUANTITIES).map(([name, textContent]) => {
      const button = make('button', { type: 'button', textContent, onclick: () => { this.quantity = name; this.picked = null; this.plot(); } });
      button.dataset.kind = name;
      return button;
    }));
    this.kinds.setAttribute('aria-label', 'Error of');
    this.chart = new LogChart('', 'wall time against error of every method', ['time of one solve, ms', 'error']);
    this.chart.upward = percentDecade;
    this.chart.head.querySelector('h2').remove();
    this.start = make('button', { type: 'button', className: 'whole', onclick: () => this.measure() });
    this.said = make('p', { className: 'help', role: 'status' });
    this.bar = make('progress', { max: 1, value: 0, hidden: true, ariaLabel: 'Measured so far' });
    this.point = make('div', { className: 'point' });
    this.point.setAttribute('aria-live', 'polite');
    this.remarks = make('details', { className: 'help' });
    this.root.append(this.said, make('div', { className: 'record-form' }, this.start, this.bar), make('div', { className: 'sides scatter' }, this.point, make('div', {}, this.kinds, this.chart.root)), this.remarks);
    page.model.on('tradeoff_running', () => this.fill());
    this.listen();
  }
  listen() {
    const { area } = this.chart;
    area.tabIndex = 0;
    area.setAttribute('role', 'application');
    area.setAttribute('aria-label', 'Points of wall time and error: arrow keys go from one to the next, Enter shows it on the page');
    area.onpointermove = (event) => this.point_at(event);
    area.onpointerleave = () => { if (!this.kept) { this.picked = null; this.mark(); } };
    area.onfocus = () => { this.kept = true; if (!this.picked) this.step(0); };
    area.onblur = () => { this.kept = false; };
    area.onclick = (event) => { this.point_at(event, true); if (this.picked) showMethod(this.page, this.picked.method); };
    area.onkeydown = (event) => {
      const way = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
      if (way) { event.preventDefault(); this.step(way); }
      if (event.key === 'Enter' && this.picked) showMethod(this.page, this.picked.method);
    };
  }
  measure() {
    const { model } = this.page;
    model.tradeoff_running = !model.tradeoff_running;
    this.fill();
  }
  told(found, fresh) {
    const running = this.page.model.tradeoff_running, points = found?.points ?? [];
    this.root.setAttribute('aria-busy', String(!fresh && !running));
    this.start.textContent = running ? 'Cancel' : points.length && found.here ? 'Measure again' : 'Measure on this machine';
    this.start.setAttribute('aria-pressed', String(running));
    this.bar.hidden = !running;
    this.bar.value = Math.min((found?.seconds ?? 0) / (found?.budget ?? 12), 1);
    const other = running && !fresh ? ' What is measured now are the choices of before.' : '';
    this.said.textContent = found?.error ?? (!found ? 'Looking for a table …' : !points.length ? `No table of this scene is known yet. ${running ? 'Measuring …' : 'Measuring it takes some twelve seconds; the page goes on meanwhile.'}` : this.words(found, running) + other);
    this.remarks.replaceChildren(...(found?.remarks?.length ? [make('summary', { textContent: 'What does not get better, and what was left out' }), ...found.remarks.map((remark) => make('p', { textContent: this.remark(remark) }))] : []));
    this.chart.root.parentElement.parentElement.hidden = !points.length;
    if (points.length) this.plot();
  }
  words(found, running) {
    const where = found.here ? 'on this machine' : `on ${found.machine.processor} (${found.machine.cores} cores, Python ${found.machine.python}), another machine than this`;
    const count = found.points.length, points = `${count} point${count === 1 ? '' : 's'}`;
    const state = running ? `${points} so far, ${figures(found.seconds, 2)} s` : found.stopped ? `${points}, then ${found.stopped}` : `${points}, ${found.date}`;
    return `Measured ${where}: ${state}. Errors are against the truth, ${plainly(found.reference.words)}.`;
  }
  // "modal: the peak-force does not tend ..." in the words of the page.
  remark(said) {
    const [, name, rest] = said.match(/^([a-z-]+(?: \w+=[\w.-]+)*): (.*)$/) ?? ['', '', said];
    const words = plainly(rest).replace(/\b(peak|resolved)-force\b/g, '$1 force').replace('force-history', QUANTITIES['force-history']).replace('contact-time', QUANTITIES['contact-time']);
    return name ? `${described(name)}: ${words}` : words;
  }
  // What the chosen quantity makes of the points.
  plot() {
    const found = this.answer, { chart, quantity } = this;
    if (!found?.points?.length) return;
    for (const button of this.kinds.children) button.setAttribute('aria-pressed', String(button.dataset.kind === quantity));
    const floor = Math.max(found.reference.uncertainty?.[quantity] ?? 0, LEAST);
    const told = found.points.map((row) => Math.abs(row.errors[quantity] ?? 0)).filter((error) => error > 10 * floor);
    const least = Math.max(floor / 2, Math.min(...told, 1) / LEFT); // what is nearer by far lies at the lower edge
    this.points = found.points.filter((row) => Number.isFinite(row.errors[quantity])).map((row) => ({ ...row, time: 1e3 * row.wall_time, size: Math.max(Math.abs(row.errors[quantity]), least) })).sort((a, b) => a.time - b.time);
    this.floor = Math.max(floor, 2 * least);
    const times = this.points.map((p) => p.time), sizes = this.points.map((p) => p.size);
    chart.x = [0.6 * Math.min(...times, 1), 1.7 * Math.max(...times, 10)];
    chart.y = [0.5 * Math.min(...sizes, this.floor), 2.5 * Math.max(...sizes, 0.1)];
    chart.named[1] = `error in the ${QUANTITIES[quantity]}`;
    const names = [...new Set(this.points.map((p) => p.method.name))];
    chart.legend.replaceChildren(...names.map((name) => { const mark = make('i', { className: 'dot' }); mark.style.background = COLOURS[name] ?? '#333'; return make('span', { className: 'key' }, mark, naming(name)); }));
    if (this.picked) this.picked = this.points.find((p) => p.label === this.picked.label) ?? null;
    this.draw();
  }
  draw() {
    const { chart } = this;
    if (this.root.hidden || !this.points || !chart.fit()) return;
    const c = chart.begin(chart.below), { box } = chart;
    chart.clip(c);
    if (this.floor > chart.y[0]) { // below the uncertainty of the truth nothing can be told
      c.fillStyle = 'rgba(100,115,130,.13)';
      c.fillRect(box.x, chart.py(this.floor), box.w, box.y + box.h - chart.py(this.floor));
    }
    for (const ladder of new Set(this.points.map((p) => p.ladder))) {
      const own = this.points.filter((p) => p.ladder === ladder);
      c.strokeStyle = COLOURS[own[0].method.name] ?? '#333';
      c.globalAlpha = 0.28;
      c.lineWidth = 1.5;
      c.beginPath();
      own.forEach((p, k) => (k ? c.lineTo(chart.px(p.time), chart.py(p.size)) : c.moveTo(chart.px(p.time), chart.py(p.size))));
      c.stroke();
      c.globalAlpha = 1;
    }
    c.strokeStyle = '#1c2733';
    c.lineWidth = 2;
    for (const [front, dash] of [[this.front(), []], [this.rest(), [5, 4]]]) {
      c.setLineDash(dash);
      c.beginPath();
      front.forEach((p, k) => { if (k) { c.lineTo(chart.px(p.time), chart.py(front[k - 1].size)); c.lineTo(chart.px(p.time), chart.py(p.size)); } else c.moveTo(chart.px(p.time), chart.py(p.size)); });
      c.stroke();
      c.setLineDash([]);
    }
    for (const p of this.points) this.dot(c, p, p.best_for.includes(this.quantity) ? 5 : 3.6);
    c.restore();
    chart.axes(c);
    this.mark();
  }
  // What nothing beats in time and error at once; and the same without exact waves.
  front() { return this.points.filter((p) => p.best_for.includes(this.quantity)); }
  rest() {
    let best = Infinity;
    if (!this.front().some((p) => p.method.name === 'waves')) return [];
    return this.points.filter((p) => p.method.name !== 'waves' && p.size < best && (best = p.size));
  }
  dot(c, p, size) {
    c.fillStyle = COLOURS[p.method.name] ?? '#333';
    c.strokeStyle = shown(this.page, p.method) ? '#c81e4a' : '#fff';
    c.lineWidth = shown(this.page, p.method) ? 2 : 1;
    c.beginPath(); c.arc(this.chart.px(p.time), this.chart.py(p.size), size, 0, 7); c.fill(); c.stroke();
  }
  point_at(event, touched) {
    const { chart } = this, from = chart.area.getBoundingClientRect();
    if (!this.points || !chart.box) return;
    const away = (p) => Math.hypot(chart.px(p.time) - (event.clientX - from.left), chart.py(p.size) - (event.clientY - from.top));
    const nearest = this.points.reduce((best, p) => (away(p) < away(best) ? p : best), this.points[0]);
    const picked = nearest && away(nearest) < (touched ? 2 * NEAR : NEAR) ? nearest : null;
    if (picked === this.picked || (!picked && !touched)) return;
    this.picked = picked;
    this.mark();
  }
  step(way) {
    if (!this.points?.length) return;
    const at = this.points.indexOf(this.picked);
    this.picked = this.points[at < 0 ? 0 : (at + way + this.points.length) % this.points.length];
    this.mark();
  }
  mark() {
    const { chart, picked } = this;
    if (!chart.box) return;
    const c = chart.begin(chart.above);
    if (picked) {
      c.strokeStyle = '#c81e4a';
      c.lineWidth = 2;
      c.beginPath(); c.arc(chart.px(picked.time), chart.py(picked.size), 9, 0, 7); c.stroke();
    }
    this.explain();
  }
  // The point under the pointer, or, without one, the best there are.
  explain() {
    const p = this.picked;
    if (!p) {
      const rest = this.rest(), line = (each) => make('tr', shown(this.page, each.method) ? { ariaCurrent: 'true' } : {}, make('td', {}, make('button', { type: 'button', className: 'when', textContent: described(each.label), onclick: () => showMethod(this.page, each.method) })), make('td', { textContent: ms(each.wall_time) }), make('td', { textContent: signed(each.errors[this.quantity]) }));
      const rows = [...this.front().map(line), ...(rest.length ? [make('tr', {}, make('th', { scope: 'rowgroup', colSpan: 3, textContent: 'and without the exact waves (dashed)' }))] : []), ...rest.map(line)];
      const head = make('thead', {}, make('tr', {}, ...['Nothing is quicker and nearer', 'one solve', 'error'].map((textContent) => make('th', { scope: 'col', textContent }))));
      this.point.replaceChildren(make('table', { className: 'methods' }, head, make('tbody', {}, ...rows)), make('p', { className: 'help', textContent: 'Point at a dot to read it; a click shows that method and resolution on the page.' }));
      return;
    }
    const spread = p.spread ? ` (${ms(p.spread[0])} to ${ms(p.spread[1])})` : '';
    const contacts = `${p.true_contacts_found} of ${p.true_contacts}${p.invented_contacts ? `, and ${p.invented_contacts} that ${p.invented_contacts === 1 ? 'is' : 'are'} none` : ''}`;
    const rows = [['One solve', ms(p.wall_time) + spread], ...Object.entries(QUANTITIES).filter(([name]) => name in p.errors).map(([name, text]) => [`Error in the ${text}`, signed(p.errors[name])]), ['Says of its own rebound', p.estimated_error === null ? '–' : `± ${share(p.estimated_error)}`], ['Contacts found', contacts]];
    this.point.replaceChildren(make('h3', { textContent: described(p.label) }), make('table', {}, make('tbody', {}, ...rows.map((cells) => make('tr', {}, ...cells.map((textContent) => make('td', { textContent })))))), ...p.notes.slice(0, 2).map((note) => make('p', { className: 'help', textContent: plainly(note) })));
  }
}
