// What happened, in words and figures: events, contact table, answers of both methods beside the classical one.
import { pretty } from './controls.js';

const make = (tag, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
};
const percent = (share) => `${(100 * share).toFixed(Math.abs(share) < 0.0995 ? 2 : 1)} %`;
const signed = (value, digits = 3) => `${value < 0 && Number(value.toFixed(digits)) !== 0 ? '−' : ''}${Math.abs(value).toFixed(digits)}`;
const count = (n, word) => `${n} ${word}${n === 1 ? '' : 's'}`;

// The events of a blow as [time in T, sentence].
export function events(frame) {
  const { fixed, waves, duration, chosen } = frame, rigid = chosen.law === 'rigid', found = [];
  const { contacts, left } = waves, firstEnd = contacts[0][1];
  const pressure = pretty(frame.stressUnit / 1e6);
  found.push([0, rigid
    ? `The mass touches. The end of the rod must move with it at once: a front of compression (${pressure} MPa) sets out along the rod.`
    : 'The mass touches. The contact gives way, the force grows smoothly, and a wave of compression sets out along the rod.']);
  const wave = rigid ? 'front' : 'wave';
  if (duration > 0.5) found.push([0.5, fixed
    ? `The ${wave} meets the fixed end and turns back, still compression: at the wall the stress doubles.`
    : `The ${wave} meets the free end and turns back as tension.`]);
  if (firstEnd > 1 + 1e-9) found.push([1, fixed && rigid
    ? 'The front is back at the mass, which cannot change its speed at once: it is thrown back again, and the force jumps by twice its first value.'
    : 'The wave is back at the struck end.']);
  contacts.forEach(([start, end], k) => {
    if (k > 0) found.push([start, `Contact ${k + 1}: the end of the rod, thrown out by the wave still running inside, catches up with the mass and pushes it once more.`]);
    const last = k === contacts.length - 1;
    if (last && waves.stillTouching) { found.push([end, 'Here the time that was solved ends. They still touch.']); return; }
    const speed = Math.abs(left[k]);
    const goes = speed < 5e-4 ? 'the mass is left standing.' : `the mass goes ${left[k] < 0 ? 'back' : 'on, the way it came,'} at ${speed.toFixed(3)} of its speed.`;
    const why = waves.cutOff[k] && !fixed
      ? 'The returning tension pulls the end of the rod away from the mass. No contact can pull, so the force drops to zero:'
      : 'The force has faded to zero:';
    found.push([end, `${why} ${goes}${last ? ' They part for good.' : ' But a wave still runs in the rod.'}`]);
  });
  return found.filter(([t]) => t <= duration + 1e-9).sort((a, b) => a[0] - b[0]);
}

export class Story {
  constructor(go, zoom) {
    this.go = go;
    this.zoom = zoom;
    this.now = make('p', { className: 'now' });
    this.units = make('p', { className: 'symbols' });
    this.list = make('ol', { className: 'events' });
    this.match = make('p', { className: 'match' });
    this.table = make('table', { className: 'contacts' });
    this.figures = make('table', { className: 'figures' });
    this.energy = make('div', { className: 'energy' });
    this.trust = make('p', { className: 'trust' });
    const heading = (text) => make('h2', { textContent: text });
    this.root = make('aside', { className: 'story' },
      heading('What happens'), this.units, this.list, heading('Can one number stand for the waves?'), this.match,
      heading('Contact periods'), make('div', { className: 'scroll' }, this.table),
      heading('After the blow'), make('div', { className: 'scroll' }, this.figures),
      heading('Where the energy went'), this.energy, this.trust);
  }
  load(frame) {
    this.frame = frame;
    this.latest = undefined;
    this.events = events(frame);
    const trip = frame.trip < 1e-3 ? [1e6, 'µs'] : [1e3, 'ms'];
    this.units.textContent = `T = ${pretty(frame.trip * trip[0])} ${trip[1]}: a wave runs to the far end and back. v: the speed of the blow.`;
    const shown = this.events.length > 24 ? [...this.events.slice(0, 23), this.events.at(-1)] : this.events;
    this.items = shown.map(([t, sentence]) => {
      const time = make('button', { type: 'button', className: 'when', textContent: `${Number(t.toFixed(t < 0.995 ? 2 : t < 10 ? 3 : 1))} T` });
      time.onclick = () => this.go(t);
      return make('li', {}, time, make('span', { textContent: sentence }));
    });
    this.list.replaceChildren(...this.items);
    this.contacts();
    this.answers();
    this.shares();
  }
  contacts() {
    const { frame } = this, rows = [];
    const head = make('tr', {}, ...['', 'from', 'to', 'impulse', 'peak'].map((text) => make('th', { textContent: text })));
    const units = make('tr', { className: 'units' }, ...['', 'T', 'T', 'N s', 'kN'].map((text) => make('td', { textContent: text })));
    for (const [name, key] of [['waves', 'waves'], ['modes', 'modal']]) {
      frame[key].contacts.slice(0, 12).forEach(([start, end, impulse, peak], k) => {
        const look = make('button', { type: 'button', className: `when ${key}`, textContent: `${name} ${k + 1}`, title: 'look closer' });
        look.onclick = () => this.zoom(start, end);
        rows.push(make('tr', {}, make('td', {}, look), ...[start.toFixed(4), end.toFixed(4), pretty(impulse), pretty(peak / 1e3)].map((text) => make('td', { textContent: text }))));
      });
    }
    this.table.replaceChildren(make('thead', {}, head, units), make('tbody', {}, ...rows));
  }
  answers() {
    const { frame } = this, { waves, modal, ghost, match, chosen } = frame;
    const error = Math.abs(modal.final - waves.final);
    const ways = [['mass leaves at, v', 'final'], ['rod moves on at, v', 'targetFinal']];
    const rows = ways.map(([text, key]) => [text, signed(waves[key], 4), signed(modal[key], 4), signed(key === 'final' ? ghost.impactor : ghost.target, 3)]);
    const names = { newton: 'restitution e', poisson: 'e by impulses', newton_at_contact: 'e of the faces' };
    const meaning = {
      'restitution e': 'speed of parting over speed of approach, mean velocities of both bodies',
      'e by impulses': 'impulse after over impulse before the instant of equal velocities',
      'e of the faces': 'speed at which the touching faces part; it says nothing about energy',
      'error of rebound': 'waves: estimated; modes and ghost: difference from the waves, as a share of the impact speed',
    };
    for (const [key, text] of Object.entries(names)) {
      const show = (value) => (value === null ? '–' : signed(value, 4));
      rows.push([text, show(waves.restitution[key]), show(modal.restitution[key]), key === 'newton' ? chosen.restitution.toFixed(3) : '']);
    }
    rows.push(['peak force, kN', pretty(waves.peakForce / 1e3), pretty(modal.peakForce / 1e3), '–']);
    rows.push(['indentation, µm', ...[waves, modal].map((s) => (s.peakIndentation === null ? 'none' : pretty(s.peakIndentation * 1e6))), '–']);
    rows.push(['error of rebound', waves.diagnostics.estimated_error < 1e-9 ? '< 1e-9' : waves.diagnostics.estimated_error.toExponential(0), percent(error), percent(Math.abs(ghost.impactor - waves.final))]);
    rows.push(['solved in, ms', ...[waves, modal].map((s) => pretty(s.diagnostics.wall_time * 1e3)), '–']);
    const head = make('tr', {}, ...['', 'waves', count(chosen.modes, 'mode'), 'ghost'].map((text) => make('th', { textContent: text })));
    this.figures.replaceChildren(make('thead', {}, head), make('tbody', {}, ...rows.map((row) => make('tr', { title: meaning[row[0]] ?? '' }, ...row.map((text) => make('td', { textContent: text }))))));
    const says = `A restitution of ${chosen.restitution.toFixed(2)} between rigid bodies sends the mass off at ${signed(ghost.impactor)} v (dashed grey). The waves send it at ${signed(waves.final)} v: `;
    const needed = make('b', { textContent: match === null ? 'no e' : `e = ${match.toFixed(3)}` });
    const verdict = waves.contacts.length > 1
      ? ` would have matched the last velocity, but not the ${waves.contacts.length} contacts, nor when they happen.`
      : ' would have matched the last velocity, but not the force, nor the time it takes.';
    this.match.replaceChildren(says, needed, verdict);
  }
  shares() {
    const { energy, diagnostics } = this.frame.waves, parts = [];
    const names = [['impactor', 'mass'], ['target_rigid', 'rod as a whole'], ['target_vibration', 'waves left in the rod'], ['local', 'local'], ['dissipated', 'lost in the contact']];
    const bar = make('div', { className: 'bar' });
    for (const [key, name] of names) {
      const share = energy[key] / energy.initial;
      if (Math.abs(share) < 5e-5) continue;
      const piece = make('i', { className: key });
      piece.style.flexGrow = Math.max(share, 0);
      bar.append(piece);
      parts.push(make('span', { className: 'key' }, make('i', { className: `chip ${key}` }), `${name} ${percent(share)}`));
    }
    this.energy.replaceChildren(bar, make('p', {}, ...parts));
    const modal = this.frame.modal.diagnostics, most = (value) => Math.abs(value).toExponential(0);
    const notes = [...new Set([...this.frame.waves.notes, ...this.frame.modal.notes])].join(' ');
    this.trust.textContent = `Energy unaccounted for: waves ${most(diagnostics.energy_error)}, modes ${most(modal.energy_error)} of the whole. `
      + `The modes tell nothing shorter than ${pretty(modal.resolved_time * 1e6)} µs apart; their raw force made contact ${count(modal.raw_contacts, 'time')}. `
      + `${this.frame.title}. Source: ${this.frame.source}. ${notes}`;
  }
  // Mark the latest event at the instant t.
  at(t) {
    if (!this.events) return;
    let latest = -1;
    this.events.forEach(([when], k) => { if (k < this.items.length && when <= t + 1e-6) latest = k; });
    if (latest === this.latest) return;
    this.latest = latest;
    this.items.forEach((item, k) => item.toggleAttribute('aria-current', k === latest));
  }
}
