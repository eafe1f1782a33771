// The gallery: what typed words find, pictures as they are stored, and the names of scenes of one's own.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { nearest } from '../../app/static/gallery/gallery.js';
import { at, unpacked } from '../../app/static/gallery/picture.js';
import { entry, matches } from '../../app/static/gallery/search.js';
import { questionOf } from '../../app/static/opening/question.js';
import { fileOf, isOwn, LONGEST, nameOf, textOf } from '../../app/static/wire/own.js';

const CHAPTER = { code: 'scenes.thesis', severity: 'refusal', values: { chapter: '7' } };
const BEAMS = { code: 'scenes.beams', severity: 'refusal', values: {} };
const found = { method: 'modal', law: 'hertz', bodies: ['sphere', 'half-space'] };

test('words find a scene by title, number, method, law, kind and heading, in any order', () => {
  const figure = entry('figure-7.6', 'Below yield', found, CHAPTER);
  assert.equal(figure.title, 'Figure 7.6: Below yield');
  for (const typed of ['', '7.6', 'below YIELD', 'hertz modal', 'chapter 7', 'sphere', 'figure 7.', 'half-space'])
    assert.ok(matches(typed, figure), typed);
  for (const typed of ['7.60', '7.1', '6.', 'below beam', 'waves']) assert.ok(!matches(typed, figure), typed);
  assert.ok(!matches('7.6', entry('figure-7.60', 'Another', found, CHAPTER)));
  assert.ok(matches('30.7', entry('long', 'A beam of 30.7 cm', found, BEAMS)));
  assert.ok(matches('painleve', entry('painleve-rod', 'Painlevé’s rod', found, BEAMS)));
  assert.ok(matches('why', entry('long', 'A beam', found, BEAMS, 'Why three?')));
});

test('a picture is unpacked from how its frames differ, and drawn between them', () => {
  const all = unpacked([1, 5, 2, 0, -1, 4], 2);
  assert.deepEqual([...all], [1, 5, 3, 5, 2, 9]);
  assert.deepEqual(at(all, 2, 0), [1, 5]);
  assert.deepEqual(at(all, 2, 0.25), [2, 5]);
  assert.deepEqual(at(all, 2, 1), [2, 9]);
  assert.deepEqual(at(unpacked([7, 8], 2), 2, 0.6), [7, 8]); // it stands still
});

test('the name of a scene of one’s own is its text', async () => {
  const text = 'title = "Größe"\n[impactor]\nkind = "mass"\n'.repeat(20);
  const name = await nameOf(text);
  assert.match(name, /^own\.[\w-]+$/);
  assert.ok(name.length < 200 && name.length < LONGEST);
  assert.equal(await textOf(name), text);
  assert.deepEqual([isOwn(name), isOwn('fixed-rod')], [true, false]);
  assert.deepEqual([fileOf(name), fileOf('fixed-rod')], ['own-scene', 'fixed-rod']);
});

test('arrows go to the nearest choice in their way, rows first', () => {
  const box = (left, top) => ({
    getBoundingClientRect: () => ({ left, top, width: 100, height: 50 }),
  });
  const [a, b, c, d] = [box(0, 0), box(120, 0), box(0, 80), box(120, 80)];
  const all = [a, b, c, d];
  assert.equal(nearest(a, all, 'ArrowRight'), b);
  assert.equal(nearest(a, all, 'ArrowDown'), c);
  assert.equal(nearest(d, all, 'ArrowUp'), b);
  assert.equal(nearest(a, all, 'ArrowUp'), undefined);
  assert.equal(nearest(b, all, 'ArrowRight'), undefined);
});

test('a scene asks its own question until something of it is changed', () => {
  const chosen = { scene: 'two-equal-rods', mass_ratio: 1 };
  const frame = { kind: 'bodies', chosen, own: chosen, acting: ['mass_ratio'], parts: [] };
  const story = { question: () => 'that of its kind' };
  assert.match(questionOf(frame, story), /^Two equal rods meet\./);
  assert.equal(questionOf({ ...frame, chosen: { ...chosen, mass_ratio: 4 } }, story), 'that of its kind');
  const other = { ...chosen, scene: 'figure-7.6' };
  assert.equal(questionOf({ ...frame, chosen: other, own: other }, story), 'that of its kind');
});
