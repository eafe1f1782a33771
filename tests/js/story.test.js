// What is told of an impact: the sentences that depend on what happened.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { eventsOf } from '../../app/static/axial/events.js';
import { unitsOf } from '../../app/static/axial/story.js';
import { endsOf } from '../../app/static/frame/falls.js';
import { mechanismEvents } from '../../app/static/mechanism/resting_story.js';

/**
 * As much of the message of a struck mechanism as is told.
 * @param {Record<string, any>} [changed]
 * @returns {any}
 */
const mechanism = (changed = {}) => ({
  ...{ kind: 'mechanism', speed: 1, impactor: { kind: 'mass' }, rates: [], chosen: {} },
  mechanism: { struck: 0, links: [{ name: 'lower', flexible: false }] },
  main: { name: 'rigid', sudden: true, contacts: 1, final: 0.263 },
  contacts: [[0, 0, 0.368, 0]],
  ...changed,
});

test('an impulse in no time is one event, which says how large it is', () => {
  const events = mechanismEvents(mechanism());
  assert.equal(events.length, 1);
  assert.match(
    events[0][1],
    /link “lower” meet at 1\sm\/s. One impulse of 368\smN\ss, in no time.*has 0.263\sm\/s along/,
  );
  const lasting = mechanismEvents(
    mechanism({ main: { name: 'modal', contacts: 1, final: 0 }, contacts: [[0, 1, 1, 1]] }),
  );
  assert.equal(lasting.length, 2);
});

/**
 * A mass on a rod, in rigid contact.
 * @param {Record<string, any>} changed
 * @returns {any}
 */
const rod = (changed) => ({
  ...{ chosen: {}, rigid: true, duration: 3, stressUnit: 4e7, impactor: { kind: 'mass' }, rods: [{ mirror: 1 }] },
  ...{ speed: 1, target: { held: true } },
  exact: { contacts: [[0, 1.5, 1, 1]], cutOff: [true], left: [0.135] },
  ...changed,
});

test('a mass that goes on is not said to come back', () => {
  const [, sentence] = eventsOf(rod({ rods: [{ mirror: -1 }] })).at(-1) ?? [];
  assert.match(sentence ?? '', /goes on in the same direction at 0\.135\sv/);
});

test('a slow push on a rod is told as one, not as waves', () => {
  const slow = (/** @type {number} */ mirror, /** @type {number} */ end) =>
    eventsOf(
      rod({
        ...{ rigid: false, duration: 30, rods: [{ mirror }] },
        exact: { contacts: [[0, end, 1, 1]], cutOff: [false], left: [-0.9] },
      }),
    ).map(([, sentence]) => sentence);
  assert.equal(slow(1, 23).length, 3);
  assert.match(slow(1, 23)[1], /to and fro some 23 times.*like a spring, and the wall bears/);
  assert.match(slow(-1, 23)[1], /nearly as one body.*nothing at the free one/);
  for (const sentences of [slow(1, 23), slow(-1, 23)]) assert.doesNotMatch(sentences.join(' '), /doubles|as tension/);
  assert.match(slow(1, 1.7).join(' '), /the stress doubles/);
});

test('the unit of time of an impulse is not called the time of its contact', () => {
  const frame = (/** @type {string} */ name) =>
    /** @type {any} */ ({
      exact: { name, sudden: name === 'rigid' },
      impactor: {},
      rods: [],
      target: { kind: 'mass' },
      trip: 1e-3,
    });
  assert.match(unitsOf(frame('rigid')), /T = 1\sms: the unit of time of these charts; the impact itself takes none/);
  assert.match(unitsOf(frame('quasi-static')), /about the time of a contact/);
});

test('of rods that are drawn rigid no waves are told', () => {
  const other = {
    name: 'rigid',
    sudden: true,
    contacts: [[0, 0, 1, null]],
    left: [-0.5],
    cutOff: [false],
    stillTouching: false,
  };
  const by = (/** @type {string} */ method) =>
    eventsOf(rod({ target: { kind: 'rod' }, other, chosen: { law: 'rigid', method } }));
  assert.match(by('waves')[0][1], /front/);
  const events = by('rigid');
  assert.equal(events.length, 2);
  assert.doesNotMatch(events.map(([, sentence]) => sentence).join(' '), /wave|front/i);
  assert.match(events[1][1], /in no time.*goes back at 0.5/);
});

test('where the force jumps, it is said over how long modes spread the jump', () => {
  const jump = (/** @type {any} */ frame) => eventsOf(frame).find(([t]) => t === 1)?.[1] ?? '';
  const other = { diagnostics: { resolved_time: 2.35e-6 } };
  assert.match(jump(rod({ modalForce: [1], other })), /Modes spread the jump over 2\.35\sµs/);
  assert.doesNotMatch(jump(rod({ other })), /Modes/);
});

/**
 * What is told of rods with all that a message has of them, with the instants.
 * @param {Record<string, any>} changed
 */
const told = (changed) => {
  const plain = { target: { kind: 'rods', support: 'fixed' }, rods: [{}, {}], gaps: [], lastBall: null };
  return eventsOf(rod({ ...plain, ...changed })).map(([t, sentence]) => `${t} ${sentence}`);
};

test('a gap that closes and opens is told', () => {
  const gaps = [[2, 0.27, 1.4]];
  assert.match(told({ gaps })[1], /^0\.27 The gap between rods 1 and 2 closes/);
  assert.match(told({ gaps })[2], /^1\.4 Rods 1 and 2 come apart/);
  assert.equal(told({ gaps: [[2, 0.27, 3]] }).length, told({}).length + 1);
});

test('of a mass on the far end it is told what it makes of the wave, and of the force', () => {
  const target = { kind: 'rod', support: 'free', endMass: 1 };
  const [, meets, back] = told({ target, rods: [{}] });
  assert.match(meets, /^0\.5 The front meets the mass on the far end/);
  assert.match(back, /^1 The front is back at the mass.*the force jumps/);
});

test('of a row of balls it is told how the last one goes on', () => {
  const [, , last] = told({ rods: [], target: { kind: 'balls', row: [1] }, lastBall: [2.1, 0.9888] });
  assert.match(last, /^2\.1 The last ball .* 0\.989\sv/);
});

test('what falls is gone for good from what gives way to it, or where it goes on', () => {
  const back = endsOf(9.81, true, -9.81);
  assert.deepEqual([back.last, back.again.replaceAll('\u00a0', ' ')], ['falls', '2 s']);
  for (const gone of [endsOf(0, true, -1), endsOf(9.81, false, -1), endsOf(9.81, true, 1), endsOf(-9.81, true, -1)])
    assert.deepEqual(gone, { last: true, again: '' });
});
