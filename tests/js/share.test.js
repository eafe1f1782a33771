// What is saved of a solution, and where links lead.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { onlyHere, written } from '../../app/static/frame/share.js';

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

test('a link to what each machine calls itself says that it opens there alone', () => {
  for (const hostname of ['localhost', 'a.localhost', '127.0.0.1', '127.1.2.3', '[::1]'])
    assert.match(
      onlyHere({ hostname, port: '5006' }),
      /^This link opens on your machine alone.* NAME:5006”, .* http:\/\/NAME:5006\.$/,
      hostname,
    );
  assert.match(onlyHere({ hostname: 'localhost', port: '' }), / NAME”, .* http:\/\/NAME\.$/);
  for (const hostname of ['example.org', '192.168.1.20', '127.example.org', 'localhost.org', '[fe80::1]'])
    assert.equal(onlyHere({ hostname, port: '5006' }), '', hostname);
});
