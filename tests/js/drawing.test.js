// Legends, pictures and files of charts.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { keysOf } from '../../app/static/charts/legend.js';
import { reader } from '../../app/static/charts/picture.js';
import { SvgContext } from '../../app/static/charts/svg.js';

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

test('what is drawn is written as SVG, with nothing left open', () => {
  const c = new SvgContext(100, 50);
  c.save();
  c.translate(0, 10);
  c.save();
  c.beginPath();
  c.rect(0, 0, 20, 20);
  c.clip();
  c.strokeStyle = '#123456';
  c.setLineDash([4, 2]);
  c.beginPath();
  c.moveTo(1, 2);
  c.lineTo(3.14159, 4);
  c.stroke();
  c.restore();
  c.font = 'bold 11px sans-serif';
  c.fillText('a < b & "c"', 5, 6);
  c.restore();
  const text = c.toString();
  assert.match(text, /^<svg xmlns="http:\/\/www.w3.org\/2000\/svg" width="100" height="50" viewBox="0 0 100 50">/);
  assert.match(text, /d="M1 2L3.14 4" fill="none" stroke="#123456" stroke-width="1"[^>]* stroke-dasharray="4 2"/);
  assert.match(text, /font-weight="bold"[^>]*>a &lt; b &amp; &quot;c&quot;<\/text>/);
  assert.equal(text.match(/<g/g).length, text.match(/<\/g>/g).length);
  const [clip, used] = [text.match(/<clipPath id="(\w+)">/)[1], text.match(/url\(#(\w+)\)/)[1]];
  assert.equal(clip, used);
});
