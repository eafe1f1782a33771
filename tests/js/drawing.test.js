// Legends, pictures and files of charts.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { keysOf } from '../../app/static/charts/legend.js';
import { reader } from '../../app/static/charts/picture.js';

test('curves of one name stand in the legend once, with the look of the first', () => {
  const curve = { x: [], y: [] };
  const keys = keysOf({
    series: [
      { ...curve, name: 'one', style: 'exact' },
      { ...curve, name: 'two', style: 'thinOther' },
      { ...curve, name: 'two', style: 'dashedOther' },
      { ...curve, style: 'mode' },
      { ...curve, name: 'law', style: 'prediction' },
      { ...curve, name: 'and back', style: 'dots' },
    ],
    bars: { name: 'contact', spans: [], at: 0, least: 1 },
  });
  assert.deepEqual(
    keys.map(({ text, mark }) => [text, mark]),
    [
      ['one', 'line'],
      ['two', 'line'],
      ['law', 'dashes'],
      ['and back', 'dots'],
      ['contact', 'bar'],
    ],
  );
});

test('a picture is read where it is, and nowhere else', () => {
  const read = reader(Float32Array.from([1, 2, 3, 4, 5, 6]), 3, [0, 10], [0, 1]); // two columns of three rows
  assert.equal(read(1, 0), 1);
  assert.equal(read(4.9, 0.5), 2);
  assert.equal(read(5.1, 1), 6);
  assert.equal(read(10, 0), 4);
  assert.ok(Number.isNaN(read(-0.1, 0)));
  assert.ok(Number.isNaN(read(11, 0)));
  assert.ok(Number.isNaN(read(5, 1.4)));
});
