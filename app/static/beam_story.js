// What happens to a struck beam, in words and figures, tied to the moment shown.
import { called } from './beam_charts.js';
import { between } from './beam_field.js';
import { figures, prefixed } from './beam_stage.js';
import { LABELS, noteOf, plainly } from './words.js';

const make = (tag, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
};
const TOLD = 4, LISTED = 16; // contacts told as events, and in the table
const count = (n, word) => `${n} ${word}${n === 1 ? '' : 's'}`;
const percent = (share) => `${(100 * share).toFixed(Math.abs(share) < 0.0995 ? 2 : 1)} %`;
const speed = (v) => `${figures(v)} m/s`;
export const duration = (ms) => (ms === 0 ? 'no time' : Math.abs(ms) < 0.9995 ? `${figures(ms * 1e3)} µs` : Math.abs(ms) < 999.5 ? `${figures(ms)} ms` : `${figures(ms / 1e3)} s`);
const length = (m) => (Math.abs(m) < 1e-3 ? `${figures(m * 1e6)} µm` : `${figures(m * 1e3)} mm`);
const STRIKERS = { sphere: 'ball', rod: 'rod', beam: 'other beam' };
const strikerOf = (frame) => STRIKERS[frame.impactor.kind] ?? 'mass';
const struckOf = ({ beam }) => (beam.place > 0.999 * beam.length && beam.support !== 'free-free' ? 'tip' : 'struck place');

const NEAR = 0.2, HARD = 0.5; // of its length from a support; movement of the struck place over that of the contact

// The support next to the struck place, where that is so near that the contact gives way and not the beam; else null.
function holding(frame) {
  const { beam, contacts, main, time, struckPath } = frame, [first, last] = { cantilever: ['clamp'], 'pinned-pinned': ['pin', 'roller'], 'clamped-clamped': ['clamp', 'clamp'], 'free-free': [], 'pinned-free': ['pin'] }[beam.support];
  const [name, away] = first && (!last || beam.place < beam.length / 2) ? [first, beam.place] : [last, beam.length - beam.place];
  if (!name || away > NEAR * beam.length || !(main.peakIndentation > 0)) return null;
  let moved = 0;
  for (let k = 0; k < time.length && time[k] <= contacts[0][1]; k++) moved = Math.max(moved, struckPath[k]);
  return moved < HARD * main.peakIndentation ? { name, away, moved } : null;
}

// What methods without waves take the beam for.
const WAVELESS = { rigid: 'For this method the beam is rigid: all of it answers at once, in no time.', 'quasi-static': 'For this method the whole beam bends at once, as under a force at rest: no wave runs in it.' };

// The events of the blow as [time in ms, sentence].
export function beamEvents(frame) {
  const { contacts, rates, main, law } = frame, mass = strikerOf(frame), tip = struckOf(frame), found = [], last = contacts.length - 1, held = holding(frame);
  const at = (k, end) => [rates[4 * k + 2 * end], rates[4 * k + 2 * end + 1]]; // of impactor and of struck place
  const told = (k) => 4 * k + 3 < rates.length;
  found.push([contacts[0][0], WAVELESS[main.name] ? `The ${mass} touches the ${tip}. ${WAVELESS[main.name]}` : held ? `The ${mass} touches the ${tip}, only ${length(held.away)} from the ${held.name}, which holds it back almost at once: the contact has to give way, not the beam.` : `The ${mass} touches the ${tip}. ${law.name === 'rigid' ? 'The' : 'The contact gives way, the force grows, and the'} ${tip} has to go along, but of the beam behind it only the short piece that the first waves have reached: at first the ${mass} pushes on next to nothing.`]);
  contacts.forEach(([start, end], k) => {
    if (k > 0 && k < TOLD) found.push([start, told(k) && at(k, 0)[0] < 0
      ? `The ${tip} swings back and overtakes the ${mass}, which is on its way back: contact ${k + 1}.`
      : k === 1 ? `The rest of the beam holds the ${tip} back. The ${mass} catches up with it: contact 2.`
      : `Caught up again: contact ${k + 1}.`]);
    if (k === last || k >= TOLD - 1 || !told(k)) return;
    const [own, ahead] = at(k, 1);
    found.push([end, own < 0
      ? `After ${duration(end - start)} they part: the ${mass} goes back at ${speed(-own)}, the ${tip} ${ahead < 0 ? 'back' : 'on'} at ${speed(Math.abs(ahead))}.`
      : k === 0 ? `The ${tip} has been thrown ahead: it moves at ${speed(ahead)}, the ${mass} at ${speed(own)}. After ${duration(end - start)} they part, and the ${mass} has given away ${percent(1 - own / frame.impactorRate[0])} of its speed.`
      : `Thrown ahead again: the ${tip} at ${speed(ahead)}, the ${mass} at ${speed(own)}.`]);
  });
  if (last === TOLD) found.push([contacts[TOLD][0], `Caught up again: contact ${TOLD + 1}.`]);
  else if (last > TOLD) found.push([contacts[TOLD][0], `The same again and again: contacts ${TOLD + 1} to ${main.contacts}. Each passes a little of the push on to a longer piece of the beam.`]);
  const turn = turningPoint(frame), slow = frame.span.apparent > 0.7 * (frame.span.half ?? Infinity);
  if (turn && turn[0] < contacts[last][1]) found.push([turn[0], `The ${mass} stands still, ${length(turn[1])} from where it touched${slow ? '; the beam is bent as a whole, and' : '. What has given way'} drives it back from here.`]);
  if (main.contacts <= contacts.length) {
    const end = contacts[last][1], leaves = main.final;
    found.push([end, main.stillTouching ? 'Here the time that was solved ends. They still touch.'
      : `The ${last ? 'last ' : ''}contact is over: the ${mass} ${Math.abs(leaves) < 5e-4 * frame.speed ? 'is left standing' : `goes ${leaves < 0 ? 'back' : 'on'} at ${speed(Math.abs(leaves))}`}. They part for good.`]);
  }
  return found.sort((a, b) => a[0] - b[0]);
}

// When the impactor stands still for the first time, and how far it has come [ms, m].
function turningPoint({ time, impactorRate, impactorPath }) {
  for (let k = 1; k < time.length; k++) if (impactorRate[k] <= 0) return [time[k], impactorPath[k]];
  return null;
}

export class BeamStory {
  constructor(page) {
    this.page = page;
    this.now = make('p', { className: 'now' });
    this.list = make('ol', { className: 'events' });
    this.why = make('p', { className: 'match' });
    this.span = make('p', { className: 'match span' });
    this.doubts = make('ul', { className: 'doubts' });
    this.table = make('table', { className: 'contacts' });
    this.answers = make('table', { className: 'figures' });
    this.beside = make('p', { className: 'help' });
    this.energy = make('div', { className: 'energy' });
    this.source = make('p', { className: 'trust' });
    const heading = (textContent) => make('h2', { textContent });
    this.doubtsHeading = heading('What to doubt');
    this.whyHeading = heading('');
    this.root = make('aside', { className: 'story' },
      heading('What happens'), this.list, this.whyHeading, this.why, this.span, this.doubtsHeading, this.doubts,
      heading('Contact periods'), make('div', { className: 'scroll' }, this.table), heading('After the blow'), make('div', { className: 'scroll' }, this.answers), this.beside,
      heading('Where the energy went'), this.energy, this.source);
  }
  load(frame) {
    this.frame = frame;
    this.latest = undefined;
    this.events = beamEvents(frame);
    this.items = this.events.map(([t, sentence]) => make('li', {},
      make('button', { type: 'button', className: 'when', textContent: duration(t).replace('no time', '0'), onclick: () => this.page.player.go(t + 1e-6) }), make('span', { textContent: sentence })));
    this.list.replaceChildren(...this.items);
    this.reasons();
    this.contactTable();
    this.figures();
    this.shares();
    const { main, reference } = frame, unlike = reference && reference.contacts !== main.contacts;
    const notes = [...(unlike ? [`By ${called(reference)} instead of ${called(main)} the blow has ${count(reference.contacts, 'contact')}, not ${main.contacts}: do not trust single contacts. “How far to trust this” tells what can be trusted.`] : []), ...(frame.refused ? [`${LABELS.method[2][frame.chosen.method]}: ${frame.refused}. Modes are shown instead.`] : []), ...frame.main.notes, ...(frame.reference ? frame.reference.notes.filter((n) => !frame.main.notes.includes(n)).map((n) => `Beside it, ${called(frame.reference)}: ${n}`) : [])];
    this.doubts.replaceChildren(...notes.map((note) => make('li', { textContent: plainly(note) })));
    this.doubts.hidden = this.doubtsHeading.hidden = !notes.length;
    const { keptModes, drawnModes } = frame;
    const drawn = keptModes > drawnModes ? ` The pictures are drawn from the lowest ${drawnModes} of ${keptModes} modes.` : '';
    this.source.textContent = `${[`${frame.title}.${frame.source ? ` Source: ${frame.source}.` : ''}`, noteOf(frame)].filter(Boolean).join(' ')}${drawn}`;
  }
  // Why so many contacts, or why only one; and how long the whole takes.
  reasons() {
    const { main, span, beam } = this.frame, mass = strikerOf(this.frame), tip = struckOf(this.frame), many = main.contacts > 1, held = WAVELESS[main.name] ? null : holding(this.frame);
    this.whyHeading.textContent = many ? `Why one blow is ${main.contacts} contacts` : 'One contact, and why';
    this.why.textContent = held
      ? `So near the ${held.name} (${length(held.away)}) the beam hardly gives way: during the first contact the ${tip} moves ${length(held.moved)}, while the contact is pressed in by ${length(main.peakIndentation)}. The ${mass} turns round as on a wall, and only a little of the blow runs along the beam.`
      : many ? `Bending does not run through a beam at one speed: short waves run ahead, long ones follow (see the picture of the beam against time). So the ${mass} meets a beam that is light at first and grows heavier. It throws the light piece ahead, the rest holds that piece back, the ${mass} catches up and throws it ahead once more, until the whole beam moves with it.`
      : WAVELESS[main.name] ? `${WAVELESS[main.name]} So it knows one contact only; choose “Modes” to see how many there are.`
      : `Here the force ends once and for all: the ${mass} has gone before the ${tip} can come back to it. A heavier ${mass}, or a harder contact, is hit more than once.`;
    const share = span.apparent > 0 ? span.real / span.apparent : 1, said = [];
    if (span.real > 0) said.push(many ? `From the first touch to the last parting it takes ${duration(span.apparent)}, but they press on each other during only ${duration(span.real)} of it (${percent(share)}).` : `They touch for ${duration(span.apparent)}.`);
    if (span.half && main.name !== 'rigid' && !held) {
      const ratio = span.apparent / span.half, riding = `With the ${mass} riding on it this beam swings half a period in ${duration(span.half)}`;
      said.push(ratio > 0.75 && ratio < 1.3 ? `${riding}, and the blow lasts ${figures(ratio)} of that: seen from afar it is one slow push, by the beam as a spring, handed on in ${count(main.contacts, 'piece')}.`
        : ratio <= 0.75 ? `${riding}; the blow is over after ${figures(ratio)} of that, before the beam as a whole can answer.`
          : `${riding}; the blow lasts ${figures(ratio)} times as long${many ? ', as they meet again later' : ': the contact gives way more than the beam'}.`);
    }
    if (beam.endMass) said.push(`A mass of ${figures(beam.endMass)} kg is fixed to the tip.`);
    this.span.textContent = said.join(' ');
  }
  contactTable() {
    const { frame } = this, rows = [], [factor, prefix] = prefixed(frame.main.peakForce ?? 0);
    const head = make('tr', {}, ...['', 'from', 'to', 'impulse', 'peak'].map((textContent) => make('th', { textContent })));
    const units = make('tr', { className: 'units' }, ...['', 'ms', 'ms', 'N s', `${prefix}N`].map((textContent) => make('td', { textContent })));
    const digits = Math.min(Math.max(5 - Math.floor(Math.log10(frame.duration)) - 1, 0), 4); // as many as fit
    frame.contacts.slice(0, LISTED).forEach(([start, end, impulse, peak], k) => {
      const look = make('button', { type: 'button', className: 'when', textContent: `contact ${k + 1}`, title: 'look closer', onclick: () => this.page.zoom(start, end) });
      rows.push(make('tr', {}, make('td', {}, look), ...[start.toFixed(digits), end.toFixed(digits), figures(impulse), peak ? figures(peak * factor) : '–'].map((textContent) => make('td', { textContent }))));
    });
    if (frame.main.contacts > LISTED) rows.push(make('tr', {}, make('td', { colSpan: 5, textContent: `and ${frame.main.contacts - LISTED} more` })));
    this.table.replaceChildren(make('thead', {}, head, units), make('tbody', {}, ...rows));
  }
  figures() {
    const { frame } = this, { main, reference, span } = frame, both = reference ? [main, reference] : [main], [factor, prefix] = prefixed(main.peakForce ?? 0);
    const value = (v, digits = 4) => (v === null || v === undefined ? '–' : figures(v, digits)), micro = (v) => (v === null ? 'none' : figures(v * 1e6));
    const rows = [['contacts', (s) => s.contacts], ['impactor leaves, m/s', (s) => value(s.final)]];
    if (!frame.beam.held) rows.push(['beam goes on, m/s', (s) => value(s.targetFinal)]);
    rows.push(['restitution e', (s) => value(s.restitution.newton)], ['impulse, N s', (s) => value(s.impulse)], [`peak force, ${prefix}N`, (s) => (s.peakForce === null ? '–' : figures(s.peakForce * factor))], ['indentation, µm', (s) => micro(s.peakIndentation)]);
    if (both.some((s) => s.residualIndentation)) rows.push(['crater left, µm', (s) => micro(s.residualIndentation)]);
    rows.push(['apparent contact, ms', (s) => (s === main ? figures(span.apparent) : '')], ['true contact, ms', (s) => (s === main ? figures(span.real) : '')], ['energy unaccounted for', (s) => Math.abs(s.diagnostics.energy_error).toExponential(0)], ['solved in, ms', (s) => figures(s.diagnostics.wall_time * 1e3)]);
    this.beside.textContent = reference ? `${called(reference)}: the same blow solved once more, to see what depends on their number.` : '';
    const head = make('tr', {}, ...['', ...both.map(called)].map((textContent) => make('th', { textContent })));
    this.answers.replaceChildren(make('thead', {}, head), make('tbody', {}, ...rows.map(([name, show]) => make('tr', {}, make('td', { textContent: name }), ...both.map((s) => make('td', { textContent: show(s) }))))));
  }
  shares() {
    const { energy } = this.frame.main, parts = [], bar = make('div', { className: 'bar' });
    const split = 'target_kinetic' in energy && 'target_strain' in energy;
    const names = [['impactor', 'impactor'], ['target_rigid', 'beam as a whole'], ...(split ? [['target_kinetic', 'beam, moving'], ['target_strain', 'beam, bent']] : [['target_vibration', 'waves left in it']]), ['local', 'in the contact'], ['dissipated', this.frame.law.yields && !['balance', 'rigid'].includes(this.frame.main.name) ? 'lost by yielding' : 'lost']];
    for (const [key, name] of names) {
      const share = (energy[key] ?? 0) / energy.initial;
      if (Math.abs(share) < 5e-5) continue;
      const piece = make('i', { className: key });
      piece.style.flexGrow = Math.max(share, 0);
      bar.append(piece);
      parts.push(make('span', { className: 'key' }, make('i', { className: `chip ${key}` }), `${name} ${percent(share)}`));
    }
    this.energy.replaceChildren(bar, make('p', {}, ...parts));
  }
  // Mark the latest event at the instant t, and say what goes on.
  at(t) {
    const { frame } = this;
    if (!this.events) return;
    let latest = -1;
    this.events.forEach(([when], k) => { if (when <= t + 1e-9) latest = k; });
    if (latest !== this.latest) this.items.forEach((item, k) => item.toggleAttribute('aria-current', k === latest));
    this.latest = latest;
    const [own, ahead] = ['impactorRate', 'struckRate'].map((name) => between(frame.time, frame[name], t)), mass = strikerOf(frame), tip = struckOf(frame), { contacts, main } = frame;
    const here = contacts.findIndex(([start, end]) => t >= start && t <= end), before = contacts.findLastIndex(([, end]) => end < t);
    const gone = here < 0 && before === contacts.length - 1;
    this.now.textContent = here >= 0 ? `Now: contact ${here + 1} of ${main.contacts}; the ${mass} at ${speed(own)}.`
      : gone ? `Now: parted. The ${mass} at ${speed(own)}, the ${tip} at ${speed(ahead)}.`
        : `Now: apart, after contact ${before + 1} of ${main.contacts}. The ${tip} at ${speed(ahead)}, the ${mass} at ${speed(own)}: ${ahead > own ? own < 0 ? 'they draw apart' : 'it runs ahead' : own < 0 ? `the ${tip} catches up` : `the ${mass} catches up`}.`;
    if (!this.page.player.played) this.now.textContent += ' “Play” shows what follows.';
    this.now.classList.toggle('touching', here >= 0);
  }
}
