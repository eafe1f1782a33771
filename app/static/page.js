// The page: wires choices, clock and views together. One message from the server per change; none while playing.
import { Analyses } from './analyses.js';
import { BeamView } from './beams.js';
import { BodiesStage } from './bodies.js';
import { Cycle, Displacements, drawnFromOther, Force, SpaceTime } from './charts.js';
import { Controls } from './controls.js';
import { at, CompactField, decode, ModalField, SampledField, WaveField } from './physics.js';
import { Player } from './player.js';
import { Connection } from './shell/connection.js';
import { Stage } from './stage.js';
import { Story } from './story.js';
import { Waiting } from './waiting.js';

const PATIENCE = 2500; // ms without an answer, after which the next change is sent all the same

const make = (tag, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
};

class Page {
  constructor(model, el) {
    this.model = model;
    this.waiter = new Waiting(model);
    this.names = Object.keys(model.spec);
    this.waiting = {};
    this.what = 'stress';
    this.controls = new Controls(model.spec, (name, value) => this.send(name, value), (sentence) => this.complain(sentence));
    this.stage = new Stage();
    this.space = new BodiesStage();
    this.space.root.hidden = true;
    this.player = new Player((t) => this.show(t));
    this.spaceTime = new SpaceTime();
    this.force = new Force();
    this.displacements = new Displacements();
    this.charts = [this.spaceTime, this.force, this.displacements];
    this.cycle = new Cycle();
    this.story = new Story((t) => this.player.go(t + 2e-4), (start, end) => this.zoom(start, end));
    this.beam = new BeamView(this);
    this.analyses = new Analyses(this);
    this.toast = make('div', { className: 'toast', role: 'status', hidden: true });
    this.whole = make('button', { type: 'button', className: 'whole', textContent: 'Show the whole blow', hidden: true, onclick: () => this.zoom() });
    el.append(...['lab.css', 'panels.css'].map((name) => make('link', { rel: 'stylesheet', href: new URL(name, import.meta.url).href })), this.layout(), this.waiter.root);
    this.connection = new Connection(model, this.root);
    this.listen(model);
    for (const name of this.names) this.controls.show(name, model[name]);
    this.root.inert = true; // until there is a scene
    this.take();
    if (model.refused) this.complain(model.refused);
    this.ready = true;
  }
  layout() {
    const colour = make('div', { className: 'segments', role: 'group' });
    colour.setAttribute('aria-label', 'Colour shows');
    for (const what of ['stress', 'velocity']) {
      const button = make('button', { type: 'button', textContent: what, onclick: () => { this.what = what; this.dress(); this.player.go(this.player.t); } });
      button.setAttribute('aria-pressed', String(what === this.what));
      colour.append(button);
    }
    this.colour = colour;
    const bar = make('header', { className: 'top' },
      make('h1', {}, 'Strikewave'), make('p', { textContent: 'One body strikes another that can bend and ring. Waves decide how it leaves.' }),
      make('div', { className: 'keep' },
        make('button', { type: 'button', textContent: 'Copy link', onclick: () => this.copyLink() }),
        make('button', { type: 'button', textContent: 'Save data', title: 'histories as comma-separated values', onclick: () => this.saveData() })),
      make('nav', { ariaLabel: 'Look closer' },
        this.energy = make('button', { type: 'button', textContent: 'Energy over time', onclick: () => this.toggleEnergy() }), ...this.analyses.buttons));
    const view = make('main', { className: 'views' },
      this.head = make('div', { className: 'stage-head' }, make('span', { className: 'caption', textContent: 'Colour shows' }), colour, this.whole),
      this.stage.root, this.space.root, ...this.beam.above, this.player.root, ...this.charts.map((c) => c.chart.root), this.cycle.chart.root, this.beam.below);
    this.root = make('div', { className: 'page' }, bar, this.choices(), view, this.aside = this.story.root, ...this.analyses.panels, this.toast);
    return this.root;
  }
  // The form; a phone shows the first of it until the others are asked for.
  choices() {
    const more = make('button', { type: 'button', textContent: 'All choices' }), root = make('section', { className: 'choices' }, this.controls.root, more);
    more.onclick = () => {
      const open = root.classList.toggle('open');
      more.setAttribute('aria-expanded', String(open));
      more.textContent = open ? 'Fewer choices' : 'All choices';
    };
    more.setAttribute('aria-expanded', 'false');
    return root;
  }
  listen(model) {
    model.on('frame', () => this.take());
    model.on('refused', () => { if (model.refused) { this.settle(); this.waiter.clear(); for (const name of this.names) if (!(name in this.waiting)) this.controls.show(name, model[name], true); this.complain(model.refused); } });
    for (const name of this.names) model.on(name, () => { if (!(name in this.waiting)) this.controls.show(name, model[name]); });
    const { panels, asked } = model.shared;
    for (const name of [...Object.values(panels), ...Object.values(asked).map(([each]) => each), 'auto_within']) model.on(name, () => { if (this.frame) this.address(this.frame.chosen); });
    for (const { chart } of [...this.charts, ...this.beam.charts]) {
      const drag = (event) => { if (event.buttons & 1) this.player.go(chart.time(event.clientX)); };
      chart.area.onpointerdown = (event) => { chart.area.setPointerCapture(event.pointerId); drag(event); };
      chart.area.onpointermove = drag;
      chart.area.ondblclick = () => this.zoom();
    }
    document.addEventListener('keydown', this.key = (event) => {
      const from = event.composedPath()[0];
      if (event.key !== ' ' || ['INPUT', 'SELECT', 'BUTTON', 'TEXTAREA'].includes(from?.tagName)) return;
      event.preventDefault();
      this.player.toggle();
    });
    this.observer = new ResizeObserver(() => { if (this.frame) { this.drawCharts(); this.player.go(this.player.t); } });
    this.observer.observe(this.stage.root);
    this.observer.observe(this.space.root);
    this.observer.observe(this.beam.stage.root);
    model.on('remove', () => { this.player.playing = false; this.observer.disconnect(); document.removeEventListener('keydown', this.key); });
  }
  // Changes go out one at a time: the next when the last is answered, and then only the newest of each.
  send(name, value) {
    this.waiting[name] = value;
    this.flush();
  }
  flush() {
    const names = Object.keys(this.waiting), left = this.asked ? PATIENCE - (performance.now() - this.asked) : 0;
    if (!names.length) return;
    if (left > 0) { // an answer that never comes must not hold the next change for good
      clearTimeout(this.patience);
      this.patience = setTimeout(() => this.flush(), left + 1);
      return;
    }
    const changes = this.waiting;
    this.waiting = {};
    let changed = false;
    for (const name of names) {
      if (Object.is(this.model[name], changes[name])) continue;
      changed = true;
      this.asked = performance.now();
      this.model[name] = changes[name];
    }
    if (!changed) return;
    this.toast.hidden = true;
    this.waiter.soon('frame', 'Solving …');
  }
  settle() {
    this.asked = 0;
    this.waiter.over('frame');
    this.flush();
  }
  take(data = this.model.frame) {
    if (!data || !data.byteLength) return;
    this.frame = decode(data);
    this.root.inert = false;
    this.analyses.take(this.frame);
    const { chosen, duration, kind } = this.frame, axial = kind === 'axial';
    this.stage.root.hidden = this.head.hidden = !axial;
    this.space.root.hidden = kind !== 'bodies';
    this.energy.hidden = kind === 'bodies';
    this.beam.hide(kind !== 'beam');
    if (this.aside !== this.told.root) this.aside.replaceWith(this.told.root);
    this.aside = this.told.root;
    for (const { chart } of this.charts) chart.root.hidden = !axial;
    this.cycle.chart.root.hidden = !axial || !this.frame.cycleDepth;
    this.spaceTime.chart.root.hidden = !axial || !this.frame.rods.length;
    if (kind === 'bodies') this.space.load(this.frame);
    else if (kind === 'beam') this.beam.load(this.frame);
    else {
      this.fields = [this.frame.rods.length ? new WaveField(this.frame) : new CompactField(this.frame), null];
      this.view = [0, duration];
      this.whole.hidden = true;
      this.force.load(this.frame);
      this.displacements.load(this.frame, this.fields);
      this.dress();
    }
    this.player.load(this.frame);
    if (!this.resumed) this.resume();
    this.settle();
    this.tell(chosen);
    window.strikewave = { page: this, frames: (window.strikewave?.frames ?? 0) + 1, drawn: performance.now() };
  }
  // What the address has opened is gone on with as if it had been opened by hand.
  resume() {
    this.resumed = true;
    if (this.model.energy_shown) this.energyOpened();
    this.analyses.resume();
  }
  // Words and address follow once the picture is painted, and not more often than they can be read.
  tell(chosen) {
    clearTimeout(this.telling);
    const write = () => {
      this.toldAt = performance.now();
      this.telling = 0;
      this.controls.arrange(this.frame);
      this.told.load(this.frame);
      this.told.at(this.player.t);
      this.address(chosen);
    };
    if (!this.toldAt) write();
    else this.telling = setTimeout(write, Math.max(40, this.toldAt + 150 - performance.now()));
  }
  get told() { return this.frame.kind === 'beam' ? this.beam.story : this.story; }
  get field() {
    return drawnFromOther(this.frame) ? this.otherField : this.fields[0];
  }
  get otherField() {
    const { frame } = this, Field = frame.modalForce ? ModalField : frame.fieldStress ? SampledField : null;
    return this.fields[1] ??= Field ? new Field(frame) : new CompactField(frame, 'other');
  }
  // Colours of stage and x-t diagram.
  dress() {
    const largest = this.fields[0].largest(this.what);
    if (this.frame.rods.length) this.spaceTime.load(this.field, this.what, largest);
    this.stage.load(this.frame, this.field, this.what, largest);
    for (const button of this.colour.children) button.setAttribute('aria-pressed', String(button.textContent === this.what));
    this.drawCharts();
  }
  drawCharts() {
    if (this.frame.kind === 'bodies') return;
    if (this.frame.kind === 'beam') { this.beam.draw(); this.analyses.draw(); return; }
    for (const chart of this.charts) if (!chart.chart.root.hidden) chart.draw(this.frame, this.view);
    this.cycle.draw(this.frame);
    this.analyses.draw();
  }
  show(t) {
    if (!this.frame) return;
    if (this.frame.kind === 'bodies') { this.space.draw(t); this.painted = (this.painted ?? 0) + 1; return; }
    if (this.frame.kind === 'beam') this.beam.show(t);
    else this.showAxial(t);
    if (!this.telling) this.told.at(t);
    if (this.model.energy_shown) this.energyCursor(t);
    this.analyses.show(t);
    this.painted = (this.painted ?? 0) + 1;
  }
  showAxial(t) {
    const { frame } = this;
    this.stage.draw(t);
    if (this.spaceTime.chart.box && !this.spaceTime.chart.root.hidden) this.spaceTime.chart.cursor(t);
    if (frame.cycleDepth) this.cycle.mark((at(frame.exactMass, t, frame.duration) - at(frame.exactEnd, t, frame.duration)) * frame.speed * frame.trip, this.force.at(t) * frame.forceUnit);
    this.force.cursor(t);
    this.displacements.cursor(t);
  }
  toggleEnergy() {
    this.model.energy_shown = !this.model.energy_shown;
    this.energyOpened();
  }
  energyOpened() {
    this.energy.setAttribute('aria-pressed', String(this.model.energy_shown));
    this.span = undefined;
    const there = () => { this.energyCursor(this.player.t); return this.span; };
    const scroll = () => window.scrollTo({ top: document.documentElement.scrollHeight, behavior: 'smooth' });
    if (this.model.energy_shown) this.waiter.expect('energy', 'Adding up the energy of every part …', there, () => this.model.energy_shown, scroll);
  }
  // The cursor of the figure below the page, moved without telling the server.
  energyCursor(t) {
    this.span ??= window.Bokeh.documents.map((d) => d.get_model_by_name('energy-cursor')).find(Boolean);
    this.span?.setv({ location: t }, { sync: false });
  }
  zoom(start, end) {
    const { duration } = this.frame;
    if (this.frame.kind === 'beam') {
      this.beam.zoom(start, end);
      this.player.go(start ?? this.player.t);
      return;
    }
    if (start === undefined) this.view = [0, duration];
    else {
      const margin = Math.max(0.35 * (end - start), 1e-4 * duration);
      this.view = [Math.max(0, start - margin), Math.min(duration, end + margin)];
      this.player.go(start);
    }
    this.whole.hidden = start === undefined;
    this.drawCharts();
    this.show(this.player.t);
  }
  complain(sentence) {
    this.toast.textContent = sentence;
    this.toast.hidden = false;
    clearTimeout(this.hush);
    this.hush = setTimeout(() => { this.toast.hidden = true; }, 8000);
  }
  // The address always says what is shown, and what is open and asked.
  address(chosen) {
    const query = new URLSearchParams();
    for (const name of this.names) if (name === 'scene' ? chosen.scene !== this.model.spec.scene.default : chosen[name] !== this.model.spec[name].default || chosen.scene !== this.model.spec.scene.default) query.set(name, chosen[name]);
    const { model } = this, { panels, asked } = model.shared, open = Object.keys(panels).filter((name) => model[panels[name]]);
    if (open.length) query.set('panel', open.join(','));
    for (const [key, [name, panel, within]] of Object.entries(asked)) if (open.includes(panel) && (!within || model.auto_within === within)) query.set(key, model[name]);
    const text = query.toString().replaceAll('%2C', ',');
    history.replaceState(null, '', text ? `?${text}` : location.pathname);
  }
  async copyLink() {
    try { await navigator.clipboard.writeText(location.href); this.complain('The link to what you see is copied.'); }
    catch { this.complain(`The link to what you see: ${location.href}`); }
  }
  saveData() {
    const { frame } = this, length = frame.speed * frame.trip, points = 2000;
    if (frame.kind === 'beam') { this.download(this.beam.rows()); return; }
    if (frame.kind === 'bodies') { this.complain('There is no history to save: this blow takes no time. impact solve SCENE --json gives its figures.'); return; }
    const names = frame.other ? ['exact', 'other'] : ['exact'], called = names.map((key) => frame[key].name.replaceAll('-', '_'));
    const rows = [['time_s', ...called.map((n) => `force_${n}_N`), ...called.flatMap((n) => [`impactor_${n}_m`, `struck_face_${n}_m`])].join(',')];
    for (let k = 0; k <= points; k++) {
      const t = k / points * frame.duration;
      const forces = names.map((key) => (key === 'exact' ? this.force.at(t) : this.force.otherAt(t)) * frame.forceUnit);
      const places = names.flatMap((key) => ['Mass', 'End'].map((what) => at(frame[key + what], t, frame.duration) * length));
      rows.push([t * frame.trip, ...forces, ...places].map((v) => v.toPrecision(7)).join(','));
    }
    this.download(rows);
  }
  download(rows) {
    const link = make('a', { href: URL.createObjectURL(new Blob([rows.join('\n') + '\n'], { type: 'text/csv' })), download: `strikewave-${this.frame.chosen.scene}.csv` });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }
}

export function render({ model, el }) {
  new Page(model, el);
}
