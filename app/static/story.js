// What happened, in words and figures: events, contact table, answers of both methods beside the classical one.
import { naming } from './charts.js';
import { pretty } from './controls.js';
import { noteOf, plainly } from './words.js';

const make = (tag, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
};
const percent = (share) => `${(100 * share).toFixed(Math.abs(share) < 0.0995 ? 2 : 1)} %`;
const signed = (value, digits = 3) => `${value < 0 && Number(value.toFixed(digits)) !== 0 ? '−' : ''}${Math.abs(value).toFixed(digits)}`;
const count = (n, word) => `${n} ${word}${n === 1 ? '' : 's'}`;

const SHORT = { waves: 'waves', modal: 'modes', 'fe-nodal': 'elements', 'fe-modal': 'FE modes', 'quasi-static': 'static', 'mode-switch': 'switched', balance: 'balances', rigid: 'rigid' };
const short = (name) => SHORT[name] ?? naming(name);
const told = (frame) => [`${frame.title}. Source: ${frame.source}.`, noteOf(frame)].filter(Boolean).join(' ');
const kilo = (value) => (value === null ? '–' : pretty(value / 1e3));

// The events of a blow as [time in T, sentence].
export function events(frame) {
  return frame.rods.length === 1 && frame.rods[0].mirror ? blowOnOneRod(frame) : plainEvents(frame);
}

// For bodies of any other kind: the contacts, and what the impactor does after each.
function plainEvents(frame) {
  const { exact, rods, impactor, target } = frame, striker = { rod: 'rod', sphere: 'ball' }[impactor.kind] ?? 'mass', found = [];
  if (impactor.kind === 'pulse') return [[0, 'A force is applied to the end of the first rod, as prescribed. Its wave sets out; at every change of section or material part of it turns back.'], [exact.contacts.at(-1)[1], 'The force is over. The waves run on.']];
  const struck = { rods: 'chain of rods', mass: 'other mass', 'spring-mass': 'mass on the spring', 'half-space': 'half-space' }[target.kind] ?? target.kind;
  const waves = rods.length ? ' Waves set out from the contact; at every change of section or material part of each turns back.' : '';
  exact.contacts.forEach(([start, end], k) => {
    found.push([start, k === 0 ? `The ${striker} touches the ${struck}.${waves}` : `Contact ${k + 1}: they meet again.`]);
    const left = exact.left[k], speed = Math.abs(left), last = k === exact.contacts.length - 1;
    if (last && exact.stillTouching) { found.push([end, 'Here the time that was solved ends. They still touch.']); return; }
    const goes = speed < 5e-4 ? 'is left standing' : `goes ${left < 0 ? 'back' : 'on'} at ${speed.toFixed(3)} v`;
    found.push([end, end > start ? `The force is gone. The ${striker}, as a whole, ${goes}.${last ? ' They part for good.' : ''}` : `One impulse, in no time: the ${striker} ${goes}.`]);
  });
  return found.filter(([t]) => t <= frame.duration + 1e-9).sort((a, b) => a[0] - b[0]);
}

function blowOnOneRod(frame) {
  const { exact: waves, duration, chosen } = frame, fixed = frame.rods[0].mirror > 0, rigid = chosen.law === 'rigid', found = [];
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
    this.doubts = make('ul', { className: 'doubts' });
    this.doubtsHeading = make('h2', { textContent: 'What to doubt' });
    this.headings = ['What happens', 'Can one number stand for the waves?', 'Contact periods', 'After the blow', 'Where the energy went'].map((text) => make('h2', { textContent: text }));
    const [happens, number, periods, after, energy] = this.headings;
    this.root = make('aside', { className: 'story' },
      happens, this.units, this.list, this.doubtsHeading, this.doubts, number, this.match,
      periods, make('div', { className: 'scroll' }, this.table),
      after, make('div', { className: 'scroll' }, this.figures),
      energy, this.energy, this.trust);
  }
  load(frame) {
    this.frame = frame;
    this.latest = undefined;
    this.headings.forEach((heading, k) => { heading.hidden = frame.kind === 'bodies' && k !== 0 && k !== 3; });
    for (const part of [this.match, this.table, this.energy]) part.hidden = frame.kind === 'bodies';
    if (frame.kind === 'bodies') { this.bodies(); return; }
    this.events = events(frame);
    const trip = frame.trip < 1e-3 ? [1e6, 'µs'] : [1e3, 'ms'];
    const what = !frame.rods.length ? 'about the time of a contact' : frame.target.kind === 'rods' ? 'waves run through all rods and back' : frame.rods.length > 1 ? 'a wave runs to the far end of the struck rod and back' : 'a wave runs to the far end and back';
    this.units.textContent = `T = ${pretty(frame.trip * trip[0])} ${trip[1]}: ${what}. v: the speed of the blow.`;
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
  // One impulse between bodies in space: a sentence and the figures.
  bodies() {
    const { frame } = this, vector = (v) => v.map((c) => pretty(Math.abs(c) < 1e-12 ? 0 : c)).join(', ');
    this.events = [];
    this.units.textContent = frame.impulse > 0
      ? `The bodies touch in one point and press on each other along the normal, without friction, in no time at all. The impulse is ${pretty(frame.impulse)} N s.`
      : 'The bodies move apart: no impulse.';
    this.items = [];
    this.list.replaceChildren();
    this.figures.replaceChildren(make('tbody', {}, ...frame.figures.map(([name, value, unit]) => make('tr', {},
      make('td', { textContent: name }), make('td', { textContent: Array.isArray(value) ? vector(value) : value === null ? '–' : pretty(value) }), make('td', { textContent: unit })))));
    this.doubt(frame.notes);
    this.trust.textContent = told(frame);
  }
  doubt(notes) {
    this.doubts.replaceChildren(...notes.map((textContent) => make('li', { textContent: plainly(textContent) })));
    this.doubts.hidden = this.doubtsHeading.hidden = !notes.length;
  }
  contacts() {
    const { frame } = this, rows = [];
    const head = make('tr', {}, ...['', 'from', 'to', 'impulse', 'peak'].map((text) => make('th', { textContent: text })));
    const units = make('tr', { className: 'units' }, ...['', 'T', 'T', 'N s', 'kN'].map((text) => make('td', { textContent: text })));
    for (const key of frame.other ? ['exact', 'other'] : ['exact']) {
      frame[key].contacts.slice(0, 12).forEach(([start, end, impulse, peak], k) => {
        const look = make('button', { type: 'button', className: `when ${key}`, textContent: `${short(frame[key].name)} ${k + 1}`, title: 'look closer' });
        look.onclick = () => this.zoom(start, end);
        rows.push(make('tr', {}, make('td', {}, look), ...[start.toFixed(4), end.toFixed(4), pretty(impulse), kilo(peak)].map((text) => make('td', { textContent: text }))));
      });
    }
    this.table.replaceChildren(make('thead', {}, head, units), make('tbody', {}, ...rows));
  }
  answers() {
    const { frame } = this, { exact, other, ghost, match, chosen } = frame, both = other ? [exact, other] : [exact];
    const row = (text, show, last = '–') => [text, ...both.map(show), last];
    const value = (v, digits = 4) => (v === null ? '–' : signed(v, digits));
    const rows = [row('impactor leaves, v', (s) => value(s.final), ghost ? signed(ghost.impactor) : ''), row('target goes on, v', (s) => value(s.targetFinal), ghost ? signed(ghost.target) : '')];
    const names = { newton: 'restitution e', poisson: 'e by impulses', newton_at_contact: 'e of the faces' };
    const meaning = {
      'restitution e': 'speed of parting over speed of approach, mean velocities of both bodies',
      'e by impulses': 'impulse after over impulse before the instant of equal velocities',
      'e of the faces': 'speed at which the touching faces part; it says nothing about energy',
      'error of rebound': 'first column: estimated; the others: difference from it, as a share of the impact speed',
    };
    for (const [key, text] of Object.entries(names)) rows.push(row(text, (s) => value(s.restitution[key]), key === 'newton' ? chosen.restitution.toFixed(3) : ''));
    rows.push(row('peak force, kN', (s) => kilo(s.peakForce)));
    rows.push(row('indentation, µm', (s) => (s.peakIndentation === null ? 'none' : pretty(s.peakIndentation * 1e6))));
    if (both.some((s) => s.residualIndentation)) rows.push(row('dent left, µm', (s) => (s.residualIndentation === null ? '–' : pretty(s.residualIndentation * 1e6))));
    const estimated = (e) => (e === null ? '–' : e < 1e-9 ? '< 1e-9' : e.toExponential(0));
    rows.push(['error of rebound', estimated(exact.diagnostics.estimated_error), ...(other ? [percent(Math.abs(other.final - exact.final))] : []), ghost ? percent(Math.abs(ghost.impactor - exact.final)) : '–']);
    rows.push(row('solved in, ms', (s) => pretty(s.diagnostics.wall_time * 1e3)));
    const column = (s) => (s.name === 'modal' && frame.modalForce ? count(chosen.modes, 'mode') : short(s.name));
    const head = make('tr', {}, ...['', ...both.map(column), 'ghost'].map((text) => make('th', { textContent: text })));
    this.figures.replaceChildren(make('thead', {}, head), make('tbody', {}, ...rows.map((cells) => make('tr', { title: meaning[cells[0]] ?? '' }, ...cells.map((text) => make('td', { textContent: text }))))));
    if (!ghost) { this.match.replaceChildren('Nothing strikes: a force is prescribed, so there is nothing to restore.'); return; }
    const theory = exact.name === 'waves' ? 'The waves send' : 'This contact sends';
    const says = `A restitution of ${chosen.restitution.toFixed(2)} between rigid bodies sends the impactor off at ${signed(ghost.impactor)} v (dashed grey). ${theory} it at ${signed(exact.final)} v: `;
    const needed = make('b', { textContent: match === null ? 'no e' : `e = ${match.toFixed(3)}` });
    const verdict = exact.contacts.length > 1
      ? ` would have matched the last velocity, but not the ${exact.contacts.length} contacts, nor when they happen.`
      : ' would have matched the last velocity, but not the force, nor the time it takes.';
    const { newton, newton_at_contact: faces } = exact.restitution;
    const why = newton !== null && faces !== null && Math.abs(newton - faces) > 0.01
      ? ` The touching faces part at ${signed(faces)} v, the bodies as wholes at ${signed(newton)} v: a face moves with the waves that pass it, the whole with the impulse it got. Only the second tells what energy is left in waves.`
      : '';
    this.match.replaceChildren(says, needed, verdict, why);
  }
  shares() {
    const { exact, other } = this.frame, { energy, diagnostics } = exact, parts = [];
    const names = [['impactor', 'impactor'], ['target_rigid', 'target as a whole'], ['target_vibration', 'waves left in it'], ['local', 'local'], ['dissipated', 'lost in the contact']];
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
    const most = (value) => (value === 0 ? 'nothing' : plainly(Math.abs(value).toExponential(0)));
    this.doubt([...exact.notes, ...(other?.notes ?? []).filter((note) => !exact.notes.includes(note)).map((note) => `Beside it, ${short(other.name)}: ${note}`)]);
    const words = [`Energy unaccounted for: ${short(exact.name)} ${most(diagnostics.energy_error)}${other ? `, ${short(other.name)} ${most(other.diagnostics.energy_error)}` : ''} of the whole.`];
    const { resolved_time: finest, raw_contacts: touches } = other?.diagnostics ?? {};
    if (finest) words.push(`The modes tell nothing shorter than ${pretty(finest * 1e6)} µs apart; their raw force made contact ${count(touches, 'time')}.`);
    this.trust.textContent = `${words.join(' ')} ${told(this.frame)}`;
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
