// What is saved of a solution.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { written } from '../../app/static/frame/share.js';

test('saved values have one form, and stand below the scene that they are of', () => {
  const scene = 'title = "A rod"\n\n[target]\nlength = 0.5';
  const values = [
    [0, 9.2e-7],
    [0.0000011, -12345.6789],
  ];
  const saved = written(scene, 'http://here/?speed=2', { names: ['time_s', 'force_waves_N'], values });
  assert.deepEqual(saved.split('\n'), [
    '# title = "A rod"',
    '# ',
    '# [target]',
    '# length = 0.5',
    '# link = "http://here/?speed=2"',
    'time_s,force_waves_N',
    '0.000000e+0,9.200000e-7',
    '1.100000e-6,-1.234568e+4',
    '',
  ]);
});
