// Kept solutions in an address, there and back.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { keptOf, keptText } from '../../app/static/frame/kept.js';

/** @type {any} */
const SPEC = {
  scene: { options: ['fixed-rod', 'free-rod'] },
  law: { options: ['rigid', 'hertz'] },
  modes: { low: 1, high: 200, whole: true },
  hertz_stiffness: { low: 1e6, high: 1e14, whole: false },
};
const own = { scene: 'fixed-rod', law: 'rigid', modes: 50, hertz_stiffness: 1e10 };
/**
 * @param {any} letter
 * @param {Record<string, any>} changed
 * @returns {any}
 */
const run = (letter, changed) => ({
  letter,
  frame: { own, acting: Object.keys(own), chosen: { ...own, ...changed } },
});

test('only what differs is written, and read again', () => {
  const runs = [run('A', { modes: 5 }), run('C', { law: 'hertz', hertz_stiffness: 2.5e10 })];
  const text = keptText(runs, run('A', {}).frame);
  assert.equal(text, 'A,modes:5;C,law:hertz,hertz_stiffness:25000000000');
  assert.deepEqual(
    keptOf(text, SPEC)?.map(({ settings }) => settings.modes ?? settings.law),
    [5, 'hertz'],
  );
  assert.equal(keptText([run('B', {})], run('A', {}).frame), 'B');
  assert.deepEqual(keptOf('B', SPEC), [{ letter: 'B', settings: {} }]);
});

test('what cannot be is not read', () => {
  const bad = [
    '',
    'I',
    'A;A',
    'A,modes',
    'A,modes:',
    'A,modes:5.5',
    'A,modes:1e9',
    'A,law:steel',
    'A,toString:1',
    'A,modes:5:6',
  ];
  for (const text of bad) assert.equal(keptOf(text, SPEC), null, text);
});
