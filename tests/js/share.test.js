// What is saved of a solution.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { written } from '../../app/static/shell/share.js';

test('saved values have one form, and stand below the settings that they are of', () => {
  const chosen = { scene: 'fixed-rod', bodies: 'target.length=0.5', speed: 2, modes: 50 };
  const frame = /** @type {any} */ ({ title: 'A rod', chosen, acting: ['scene', 'bodies', 'speed'] });
  const values = [
    [0, 9.2e-7],
    [0.0000011, -12345.6789],
  ];
  const saved = written(frame, 'http://here/?speed=2', { names: ['time_s', 'force_waves_N'], values });
  assert.deepEqual(saved.split('\n'), [
    '# title = A rod',
    '# scene = fixed-rod',
    '# speed = 2',
    '# target.length = 0.5',
    '# link = http://here/?speed=2',
    'time_s,force_waves_N',
    '0.000000e+0,9.200000e-7',
    '1.100000e-6,-1.234568e+4',
    '',
  ]);
});
