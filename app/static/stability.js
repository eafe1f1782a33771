// Where each integrator keeps the energy, chatters or fails: one small map each, over step and contact stiffness.
import { share } from './advice.js';
import { decade, LogChart } from './logplot.js';
import { make, Panel } from './panel.js';

const COLOURS = { ok: '#cfe6d2', slight: '#f5eeb8', error: '#f3c58a', chatter: '#b9d2ea', stopped: '#dfe4e9', lasting: '#b99bd0', failed: '#c64a52', none: '#ffffff' };
const WORDS = { ok: 'energy kept to 10⁻⁶', slight: 'to 1 %', error: 'wrong by more', chatter: 'chatters', stopped: 'stopped at its bound', lasting: 'never parts', failed: 'grows past reason' };

class Small {
  constructor() {
    this.chart = new LogChart('', 'map of stability over step and contact stiffness', ['contact stiffness, in element stiffnesses or as the law has it', 'step × highest frequency, rad']);
    this.said = make('p', { className: 'help' });
    this.root = make('div', { className: 'small-map' }, this.chart.root, this.said);
    this.chart.area.onpointermove = (event) => { this.chart.value.textContent = this.at(this.chart.under(event)); };
    this.chart.area.onpointerleave = () => { this.chart.value.textContent = ''; };
  }
  load(found, map) {
    Object.assign(this, { found, map });
    const { chart } = this, ends = (values) => { const half = Math.sqrt(values[1] / values[0]); return [values[0] / half, values.at(-1) * half]; };
    chart.x = ends(found.stiffness);
    chart.y = ends(found.step);
    chart.head.querySelector('h2').textContent = map.name === 'modal' ? `${map.label} (the page’s own)` : map.label;
    const worst = map.worst === null ? '' : ` Energy error of the others at most ${map.worst > 1e-3 ? share(map.worst) : map.worst > 0 ? decade(Math.ceil(Math.log10(map.worst))) : 0}.`;
    this.said.textContent = map.reason ?? `${map.failures ? `${map.failures} of ${map.count} runs fail` : `None of ${map.count} runs fails`}${map.chattering ? `, ${map.chattering} chatter` : ''}.${worst} Theory: ${map.limit_name}.`;
  }
  kind(i, j) { return this.found.kinds[Number(this.map.runs[i][j])]; }
  draw() {
    const { chart, found, map } = this;
    if (!map || !chart.fit()) return;
    const c = chart.begin(chart.below), { box } = chart, rows = found.step.length, columns = found.stiffness.length;
    for (let i = 0; i < rows; i++) for (let j = 0; j < columns; j++) {
      c.fillStyle = COLOURS[this.kind(i, j)];
      c.fillRect(box.x + box.w * j / columns, box.y + box.h * (rows - 1 - i) / rows, box.w / columns + 0.6, box.h / rows + 0.6);
    }
    chart.axes(c);
    chart.clip(c);
    this.limit(c);
    c.restore();
    const inside = (v, [low, high]) => Math.min(Math.max(v, low), high), [step, stiffness] = found.here;
    c.fillStyle = '#c81e4a';
    c.strokeStyle = '#fff';
    c.lineWidth = 1.5;
    c.beginPath(); c.arc(chart.px(inside(stiffness, chart.x)), chart.py(inside(step, chart.y)), 4.5, 0, 7); c.fill(); c.stroke();
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
      const x = chart.px(found.stiffness[j]), y = chart.py(step);
      if (pen) c.lineTo(x, y); else c.moveTo(x, y);
      pen = true;
    });
    c.stroke();
  }
  at([stiffness, step, u, w]) {
    if (!this.map || u < 0 || u >= 1 || w < 0 || w >= 1) return '';
    const kind = this.kind(Math.floor(w * this.found.step.length), Math.floor(u * this.found.stiffness.length));
    return `stiffness ${stiffness.toPrecision(2)}, step ${step.toPrecision(2)} rad: ${WORDS[kind] ?? 'not run'}`;
  }
}

export class Stability extends Panel {
  constructor(page) {
    super(page, 'stability', 'Stability', 'where each integrator keeps the energy, chatters or fails', 'Where each integrator keeps the energy, chatters or fails');
    this.said = make('p', { className: 'help', role: 'status' });
    this.start = make('button', { type: 'button', className: 'whole', onclick: () => this.run() });
    this.bar = make('progress', { max: 1, value: 0, hidden: true, ariaLabel: 'Worked out so far' });
    this.key = make('p', { className: 'legend' });
    this.grid = make('div', { className: 'small-maps' });
    this.root.append(this.said, make('div', { className: 'record-form' }, this.start, this.bar), this.key, this.grid);
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
  told(found) {
    const running = this.page.model.stability_running, away = this.page.frame.kind === 'bodies';
    this.bar.hidden = !running;
    this.bar.value = found?.of ? found.done / found.of : 0;
    this.start.disabled = away && !running;
    this.start.textContent = running ? 'Cancel' : this.known || found?.maps ? 'Work it out again' : 'Work it out';
    if (found?.maps && found !== this.known) { this.known = found; this.load(found); }
    const { known } = this, stale = known && !this.fresh(known);
    this.root.setAttribute('aria-busy', String(Boolean(stale)));
    this.said.textContent = running ? `Striking with steps from ${known ? 'short to long' : 'a hundredth to five periods'}, at contacts from soft to stiff …`
      : away ? 'Bodies in space have no step to choose: their blow takes no time.'
      : !known ? 'Nothing is worked out yet.'
      : stale ? 'These maps are of the choices before.' : `${known.cancelled ? 'Cancelled: what is white was not run. ' : ''}${known.notes.join(' ')} The dot is this scene at the page’s own step.`;
    this.key.hidden = this.grid.hidden = !known;
    this.draw();
  }
  load(found) {
    while (this.maps.length < found.maps.length) this.maps.push(new Small());
    this.grid.replaceChildren(...found.maps.map((map, k) => { this.maps[k].load(found, map); return this.maps[k].root; }));
  }
  draw() { if (!this.root.hidden && this.known) for (const map of this.maps) map.draw(); }
}
