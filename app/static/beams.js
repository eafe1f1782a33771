// Everything that is shown of a blow on a beam: stage, views over time, dispersion, contact law, story.
import { BeamForce, BeamMotion, BeamSpaceTime, called, Dispersion } from './beam_charts.js';
import { between, fieldOf, QUANTITIES } from './beam_field.js';
import { BeamStage } from './beam_stage.js';
import { BeamStory } from './beam_story.js';
import { Cycle } from './charts.js';
import { InView } from './in_view.js';

const SLOW_SECONDS = 16, SLOW_CONTACTS = 4;

const make = (tag, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
};

export class BeamView {
  constructor(page) {
    this.page = page;
    this.what = 'moment';
    const redraw = () => { this.draw(true); this.show(page.player.t); };
    this.stage = new BeamStage();
    this.spaceTime = new BeamSpaceTime();
    this.force = new BeamForce(redraw);
    this.motion = new BeamMotion(redraw);
    this.dispersion = new Dispersion();
    this.cycle = new Cycle();
    this.charts = [this.spaceTime, this.force, this.motion];
    this.inView = new InView([...this.charts, this.cycle, this.dispersion], (part) => this.paint(part));
    this.story = new BeamStory(page);
    this.colours = make('div', { className: 'segments', role: 'group' }, ...QUANTITIES.map((what) => make('button', { type: 'button', textContent: what, onclick: () => { this.what = what; this.dress(); redraw(); } })));
    this.colours.setAttribute('aria-label', 'Colour shows');
    this.whole = make('button', { type: 'button', className: 'whole away', textContent: 'Show the whole blow', onclick: () => page.zoom() });
    this.slow = make('button', { type: 'button', className: 'whole slow-motion', textContent: '▶ Slow motion', title: 'the first contacts, filling the views, in 16 seconds', onclick: () => this.slowly() });
    this.head = make('div', { className: 'stage-head' }, make('span', { className: 'caption', textContent: 'Colour shows' }), this.colours, this.slow, this.whole);
    this.above = [this.head, this.stage.root];
    this.below = make('div', { className: 'beam-views' }, this.story.now, ...this.charts.map(({ chart }) => chart.root), make('div', { className: 'pair' }, this.cycle.chart.root, this.dispersion.chart.root));
    this.hide(true);
  }
  hide(hidden) {
    for (const part of [...this.above, this.below]) part.hidden = hidden;
  }
  load(frame) {
    this.frame = frame;
    for (const name of ['contacts', 'referenceContacts']) if (frame[name]) frame[name] = Array.from({ length: frame[name].length / 4 }, (_, k) => [...frame[name].subarray(4 * k, 4 * k + 4)]);
    this.field = fieldOf(frame);
    this.view = [0, frame.duration];
    this.whole.classList.add('away'); // unseen, in a place that is kept
    this.slow.hidden = this.frame.contacts.length < 2;
    this.force.load(frame);
    this.motion.load(frame);
    this.dress();
    this.draw();
  }
  dress() {
    this.stage.load(this.frame, this.field, this.what);
    this.spaceTime.load(this.frame, this.field, this.what);
    for (const button of this.colours.children) button.setAttribute('aria-pressed', String(button.textContent === this.what));
  }
  draw(all = false) {
    if (this.frame && !this.below.hidden) this.inView.draw(all);
  }
  paint(part) {
    if (!this.frame) return;
    if (this.charts.includes(part)) part.draw(this.view, this.band);
    else part.draw(this.frame);
    this.point(part, this.page.player.t);
  }
  show(t) {
    this.stage.draw(t);
    for (const part of this.inView.seen) this.point(part, t);
  }
  // What a chart shows of one instant.
  point(part, t) {
    const { frame } = this;
    if (this.charts.includes(part)) part.cursor(t);
    else if (part === this.cycle && frame.cycleDepth) part.mark(between(frame.time, frame.impactorPath, t) - between(frame.time, frame.struckPath, t), this.force.at(t));
  }
  zoom(start, end) {
    const { duration } = this.frame;
    if (start === undefined) this.view = [0, duration];
    else {
      const margin = Math.max(0.35 * (end - start), 1e-5 * duration);
      this.view = [Math.max(0, start - margin), Math.min(duration, end + margin)];
    }
    this.whole.classList.toggle('away', start === undefined);
    this.draw();
  }
  // The first contacts, filling the views, and slowly.
  slowly() {
    const { contacts, duration } = this.frame, end = contacts[Math.min(SLOW_CONTACTS, contacts.length) - 1][1];
    this.page.zoom(0, end);
    this.page.player.through(0, Math.min(1.15 * end, duration), SLOW_SECONDS);
    if (window.matchMedia('(max-width: 760px)').matches) this.stage.root.scrollIntoView({ behavior: 'smooth', block: 'start' });
  }
  // Histories as rows of comma-separated values.
  rows(points = 2000) {
    const { frame } = this, name = called(frame.main).replaceAll(/\W+/g, '_');
    const found = [`time_s,force_${name}_N,impactor_m,struck_place_m,impactor_m_per_s,struck_place_m_per_s`];
    for (let k = 0; k <= points; k++) {
      const t = k / points * frame.duration;
      found.push([t / 1e3, this.force.at(t), ...['impactorPath', 'struckPath', 'impactorRate', 'struckRate'].map((key) => between(frame.time, frame[key], t))].map((v) => v.toPrecision(7)).join(','));
    }
    return found;
  }
}
