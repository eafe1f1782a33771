// What is told of an impact: the sentences that depend on what happened.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { eventsOf } from '../../app/static/axial/events.js';
import { beamEvents } from '../../app/static/beam/events.js';
import { seenIn } from '../../app/static/shell/first.js';

/**
 * As much of the message of a struck mechanism as is told.
 * @param {Record<string, any>} [changed]
 * @returns {any}
 */
const mechanism = (changed = {}) => ({
  ...{ kind: 'beam', speed: 1, impactor: { kind: 'mass' }, rates: [], chosen: {} },
  mechanism: { struck: 0, links: [{ name: 'lower', flexible: false }] },
  main: { name: 'rigid', contacts: 1, final: 0.263 },
  contacts: [[0, 0, 0.368, 0]],
  ...changed,
});

test('an impulse in no time is one event, which says how large it is', () => {
  const events = beamEvents(mechanism());
  assert.equal(events.length, 1);
  assert.match(
    events[0][1],
    /link “lower” meet at 1\sm\/s. One impulse of 368\smN\ss, in no time.*has 0.263\sm\/s along/,
  );
  const lasting = beamEvents(mechanism({ main: { name: 'modal', contacts: 1, final: 0 }, contacts: [[0, 1, 1, 1]] }));
  assert.equal(lasting.length, 2);
});

test('what is seen promises no bending of links that do not bend', () => {
  assert.doesNotMatch(seenIn(mechanism()), /bending|bends, the/);
  const moving = mechanism({ main: { name: 'multibody' }, moving: { rigid: null } });
  assert.doesNotMatch(seenIn(moving), /bend/);
  const flexible = { struck: 0, links: [{ name: 'bar', flexible: true }] };
  assert.match(seenIn({ ...moving, mechanism: flexible }), /how the struck link bends/);
  assert.doesNotMatch(seenIn({ ...moving, mechanism: flexible, moving: { rigid: { code: '' } } }), /bend/);
  assert.match(seenIn(mechanism({ main: { name: 'modal' }, mechanism: flexible })), /bending of that link/);
});

/**
 * A mass on a rod, in rigid contact.
 * @param {Record<string, any>} changed
 * @returns {any}
 */
const rod = (changed) => ({
  ...{ chosen: { law: 'rigid' }, duration: 3, stressUnit: 4e7, impactor: { kind: 'mass' }, rods: [{ mirror: 1 }] },
  exact: { contacts: [[0, 1.5, 1, 1]], cutOff: [true], left: [0.135] },
  ...changed,
});

test('a mass that goes on is not said to come back', () => {
  const [, sentence] = eventsOf(rod({ rods: [{ mirror: -1 }] })).at(-1) ?? [];
  assert.match(sentence ?? '', /goes on in the same direction at 0\.135\sv/);
});

test('of rods that are drawn rigid no waves are told', () => {
  const other = { name: 'rigid', contacts: [[0, 0, 1, null]], left: [-0.5], cutOff: [false], stillTouching: false };
  const by = (/** @type {string} */ method) =>
    eventsOf(rod({ target: { kind: 'rod' }, other, chosen: { law: 'rigid', method } }));
  assert.match(by('waves')[0][1], /front/);
  const events = by('rigid');
  assert.equal(events.length, 2);
  assert.doesNotMatch(events.map(([, sentence]) => sentence).join(' '), /wave|front/i);
  assert.match(events[1][1], /in no time.*goes back at 0.5/);
});

test('charts of force are promised where there are any', () => {
  /** @type {any} */
  const pendulum = { kind: 'axial', impactor: { kind: 'pendulum' }, target: {}, rods: [], exact: { name: 'rigid' } };
  assert.doesNotMatch(seenIn(pendulum), /force/);
  assert.match(seenIn({ ...pendulum, exact: { name: 'compliant' } }), /force/);
  assert.match(seenIn({ ...pendulum, rods: [{}] }), /waves/);
  const across = { ...pendulum, impactor: { kind: 'mass' }, target: { rotation: {} }, exact: { name: 'converged' } };
  assert.match(seenIn(across), /turns about an axis/);
});

test('where the force jumps, it is said over how long modes spread the jump', () => {
  const jump = (/** @type {any} */ frame) => eventsOf(frame).find(([t]) => t === 1)?.[1] ?? '';
  const other = { diagnostics: { resolved_time: 2.35e-6 } };
  assert.match(jump(rod({ modalForce: [1], other })), /Modes spread the jump over 2\.35\sµs/);
  assert.doesNotMatch(jump(rod({ other })), /Modes/);
});
