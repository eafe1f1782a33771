// A measured record beside the scene: sent to the server with the choices, drawn as it is moved and scaled.
import { Chart, COLORS } from './plot.js';

const LIMIT = 2e6, EXAMPLE = { scene: 'bronze-rod-steel-ball', at: '1.0', kind: 'strain' };
const UNITS = { strain: [1e6, 'µm/m'], stress: [1e-6, 'MPa'], force: [1e-3, 'kN'] };

const make = (tag, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
};
const field = (label, input, unit = '') => make('label', { className: 'part' }, make('span', { textContent: label }), input, make('span', { className: 'unit', textContent: unit }));
const STEPS = 1000, LATER = 0.5, LARGER = 5; // sliders reach so many T to both sides of the automatic shift, and so many times its scale

export class Measurement {
  constructor(page) {
    this.page = page;
    this.button = make('button', { type: 'button', textContent: 'Overlay a measurement', onclick: () => this.toggle() });
    this.button.setAttribute('aria-pressed', 'false');
    this.chart = new Chart('Measured and computed', '', 'the measured record and what the exact solution says of the same place, against time');
    this.chart.key([['computed', 'line waves'], ['measured', 'line record']]);
    this.root = make('section', { className: 'analysis record-panel', hidden: true }, make('h2', { textContent: 'A measured record' }), this.form(), this.result = make('div', { hidden: true }, this.chart.root, this.movers(), this.said = make('p', { className: 'help' })));
    for (const kind of ['dragover', 'drop']) this.root.addEventListener(kind, (event) => event.preventDefault());
    this.root.addEventListener('drop', (event) => { if (event.dataTransfer.files.length) this.takeFile(event.dataTransfer.files[0]); });
  }
  form() {
    this.file = null;
    this.picker = make('input', { type: 'file', accept: '.csv,.txt,.tsv,.dat,text/*', hidden: true, onchange: () => { if (this.picker.files.length) this.takeFile(this.picker.files[0]); this.picker.value = ''; } });
    this.kind = make('select', { onchange: () => this.ask() }, ...[['', 'as the file says'], ['strain', 'strain'], ['stress', 'stress'], ['force', 'contact force']].map(([value, textContent]) => make('option', { value, textContent })));
    this.at = make('input', { type: 'text', inputMode: 'decimal', className: 'number', value: '', placeholder: '–', onchange: () => this.ask() });
    this.sign = make('input', { type: 'checkbox', onchange: () => this.ask() });
    this.name = make('span', { className: 'file-name', textContent: 'or drop one here: a table with time and strain, stress or force, units in its first row' });
    return make('div', { className: 'record-form' },
      make('button', { type: 'button', className: 'whole', textContent: 'Choose a file', onclick: () => this.picker.click() }), this.picker,
      make('button', { type: 'button', className: 'whole', textContent: 'Try the example', onclick: () => this.example() }), this.name,
      field('Values', this.kind), field('Gauge at', this.at, 'm from the struck end'), field('Other sign', this.sign));
  }
  movers() {
    const slider = (label) => {
      const input = make('input', { type: 'range', min: 0, max: STEPS, value: STEPS / 2, oninput: () => this.moved() });
      input.setAttribute('aria-label', label);
      return input;
    };
    this.shift = slider('Shift of the record');
    this.scale = slider('Scale of the record');
    this.shiftSaid = make('output', { className: 'unit' });
    this.scaleSaid = make('output', { className: 'unit' });
    this.residual = make('output', { className: 'residual' });
    this.automatic = make('button', { type: 'button', className: 'whole', textContent: 'Automatic', title: 'the shift and the scale with the least residual', onclick: () => this.reset() });
    return make('div', { className: 'movers' }, make('label', {}, make('span', { textContent: 'Shift' }), this.shift, this.shiftSaid), make('label', {}, make('span', { textContent: 'Scale' }), this.scale, this.scaleSaid), this.residual, this.automatic);
  }
  get open() { return !this.root.hidden; }
  toggle() {
    this.root.hidden = !this.root.hidden;
    this.button.setAttribute('aria-pressed', String(this.open));
    if (this.open) { this.ask(); this.root.scrollIntoView({ behavior: 'smooth', block: 'nearest' }); }
    this.overlay();
    this.page.drawCharts();
  }
  takeFile(file, asks = true) {
    this.file = file;
    this.name.textContent = file.name;
    this.answer = this.refusal = null;
    this.result.hidden = true;
    if (asks) this.ask();
  }
  async example() {
    const text = await (await fetch(new URL('example-record.csv', import.meta.url))).blob();
    this.kind.value = EXAMPLE.kind;
    this.at.value = EXAMPLE.at;
    this.sign.checked = false;
    const other = this.page.frame.chosen.scene !== EXAMPLE.scene;
    if (other) this.page.send('scene', EXAMPLE.scene); // and its answer asks for the comparison
    this.takeFile(new File([text], 'example-record.csv (synthetic)'), !other);
  }
  // A new scene: the record in hand is drawn in its units at once, and compared anew.
  take(frame) {
    const away = frame.kind !== 'axial';
    this.button.disabled = away;
    this.button.hidden = frame.kind === 'beam';
    this.button.title = away ? 'A blow in space has no history to lay a record on' : 'a record of strain, stress or force beside this scene';
    this.root.classList.toggle('away', away);
    if (away) return;
    this.overlay();
    this.ask();
  }
  // One question at a time; when it is answered, the newest one is asked.
  async ask() {
    if (!this.file || !this.open || this.page.frame.kind !== 'axial') return;
    if (this.asking) { this.again = true; return; }
    this.asking = true;
    const { frame } = this.page, query = new URLSearchParams({ at: this.at.value.trim(), kind: this.kind.value, sign: this.sign.checked ? -1 : 1 });
    for (const name of this.page.names) query.set(name, frame.chosen[name]);
    this.root.setAttribute('aria-busy', 'true');
    this.page.waiter.soon('record', 'Comparing the record with the scene …');
    let answer;
    try { answer = await (await fetch(new URL(`record?${query}`, document.baseURI), { method: 'POST', body: this.file, headers: { 'Content-Type': 'application/octet-stream' } })).json(); }
    catch { answer = { error: `The file could not be sent. Files may have up to ${LIMIT / 1e6} MB.` }; }
    this.asking = false;
    this.root.setAttribute('aria-busy', 'false');
    this.page.waiter.over('record');
    if (this.again) { this.again = false; this.ask(); return; }
    this.answered(answer, frame);
  }
  answered(answer, frame) {
    if (answer.error && answer.error !== this.refusal) this.page.complain(answer.error); // once, not at every step of a slider
    this.refusal = answer.error;
    this.answer = answer.error ? null : { ...answer, trip: frame.trip };
    this.result.hidden = !this.answer;
    if (this.answer) this.reset();
    else { this.overlay(); this.page.drawCharts(); }
  }
  reset() {
    this.shift.value = this.scale.value = STEPS / 2;
    this.moved();
  }
  moved() {
    for (const slider of [this.shift, this.scale]) slider.style.setProperty('--fill', `${100 * slider.value / STEPS}%`);
    this.overlay();
    this.page.drawCharts();
    this.page.show(this.page.player.t);
  }
  // How far the record is moved beyond the automatic shift [T], and by what factor beyond the automatic scale.
  get later() { return LATER * (2 * this.shift.value / STEPS - 1); }
  get larger() { return LARGER ** (2 * this.scale.value / STEPS - 1); }
  // The recovered force on the page's own chart of the force, in the units of the frame that is shown.
  overlay() {
    const { frame } = this.page;
    if (!frame || frame.kind === 'bodies') return;
    const { answer } = this;
    delete frame.record;
    if (!this.open || !answer?.recovered) return;
    const time = answer.recovered.time.map((t) => (t + this.later) * answer.trip / frame.trip);
    frame.record = { time, force: answer.recovered.force.map((f) => f * this.larger / frame.forceUnit) };
  }
  model(t) {
    const { time, model } = this.answer.computed;
    if (t <= time[0]) return t < 0 ? 0 : model[0];
    if (t > time.at(-1)) return NaN;
    let low = 0, high = time.length - 1;
    while (high - low > 1) { const m = (low + high) >> 1; if (time[m] <= t) low = m; else high = m; }
    return model[low] + (model[high] - model[low]) * (t - time[low]) / (time[high] - time[low]);
  }
  // As on the server: the difference in the L2 norm, where the solution is known, over that of the solution.
  remains() {
    const { answer, later, larger } = this;
    if (!later && larger === 1) return answer.residual;
    let difference = 0, norm = 0;
    answer.time.forEach((t, k) => {
      const model = this.model(t + later);
      if (!Number.isFinite(model)) return;
      norm += model ** 2;
      difference += (answer.values[k] * larger - model) ** 2;
    });
    return norm ? Math.sqrt(difference / norm) : NaN;
  }
  draw() {
    const { answer, chart } = this;
    if (!this.open || !answer) return;
    const { later, larger } = this, [factor, unit] = UNITS[answer.kind], { computed } = answer;
    const moved = answer.values.map((v) => v * larger * factor), told = computed.model.map((v) => v * factor);
    const low = Math.min(...told, ...moved), high = Math.max(...told, ...moved), pad = 0.08 * (high - low || 1);
    chart.x = [Math.min(-0.05, Math.max(answer.time[0], -0.5)), computed.time.at(-1)];
    chart.y = [low - pad, high + pad];
    chart.unit.textContent = `${answer.kind} in ${unit}${answer.kind === 'strain' ? ', tension up' : ', compression up'}, time → in T`;
    const shift = answer.shift + later * answer.trip, share = this.remains();
    this.shiftSaid.textContent = `${(1e6 * shift).toFixed(2).replace('-', '−')} µs`;
    this.scaleSaid.textContent = `× ${(answer.scale * larger).toPrecision(4)}`;
    this.residual.textContent = Number.isFinite(share) ? `Residual ${(100 * share).toPrecision(3)} %` : 'Nothing to compare';
    this.automatic.disabled = !later && larger === 1;
    this.said.textContent = [
      `Residual: what is left of the difference in the L2 norm, as a share of the computed ${answer.kind}.`,
      answer.recovered ? (answer.kind === 'force' ? 'The record is also drawn, in green, over the contact force.' : 'The contact force recovered from this record alone is drawn, in green, over the computed one, moved and scaled alike.') : '',
      ...answer.notes].filter(Boolean).join(' ');
    if (!chart.fit()) return;
    const c = chart.begin(chart.below);
    chart.axes(c);
    chart.clip(c);
    chart.line(c, told.length, (k) => computed.time[k], (k) => told[k], COLORS.waves, 3.4); // wider, to be seen beneath the record
    chart.line(c, moved.length, (k) => answer.time[k] + later, (k) => moved[k], COLORS.record, 1.3);
    c.restore();
  }
  show(t) {
    const { chart, answer } = this;
    if (!this.open || !answer || !chart.box) return;
    const c = chart.cursor(t), [factor, unit] = UNITS[answer.kind], value = this.model(t) * factor;
    chart.dot(c, t, value, COLORS.waves);
    chart.value.textContent = Number.isFinite(value) ? `computed ${value.toPrecision(3).replace('-', '−')} ${unit}` : '';
  }
}
