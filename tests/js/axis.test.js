// What part of an axis is in view.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Axis } from '../../app/static/charts/axis.js';

function watched(low, high) {
  const axis = new Axis();
  axis.load(low, high);
  let told = 0;
  axis.watch(() => told++);
  return { axis, told: () => told };
}

test('zooming keeps the value under the pointer and stops at the whole', () => {
  const { axis, told } = watched(0, 10);
  axis.zoom(0.5, 4);
  assert.deepEqual(axis.view, [2, 7]);
  assert.ok(axis.zoomed);
  axis.zoom(2, 4);
  assert.deepEqual(axis.view, [0, 10]);
  assert.ok(!axis.zoomed);
  axis.zoom(0.5, 0);
  axis.zoom(1.5, 0);
  assert.deepEqual(axis.view, [0, 7.5]);
  axis.zoom(100, 0);
  assert.deepEqual(axis.view, [0, 10]);
  assert.equal(told(), 5);
});

test('there is an end to zooming in', () => {
  const { axis } = watched(0, 10);
  for (let k = 0; k < 100; k++) axis.zoom(0.5, 10);
  const [low, high] = axis.view;
  assert.ok(high - low >= 10e-5 * 0.999 && high - low < 1e-3, `${high - low}`);
  assert.ok(low >= 0 && high <= 10);
});

test('panning stops at the ends', () => {
  const { axis } = watched(0, 10);
  axis.show([2, 4]);
  axis.pan(3);
  assert.deepEqual(axis.view, [5, 7]);
  axis.pan(99);
  assert.deepEqual(axis.view, [8, 10]);
  axis.pan(-99);
  assert.deepEqual(axis.view, [0, 2]);
  axis.reset();
  assert.deepEqual(axis.view, [0, 10]);
});

test('looking at a stretch leaves room about it, as far as there is any', () => {
  const { axis } = watched(0, 10);
  axis.lookAt(4, 6, 0);
  assert.deepEqual(axis.view, [3.3, 6.7]);
  axis.lookAt(0, 1, 0);
  assert.deepEqual(axis.view, [0, 1.35]);
  axis.lookAt(5, 5, 0.01);
  assert.deepEqual(axis.view, [4.9, 5.1]);
});

test('a new whole is all in view and tells nobody', () => {
  const { axis, told } = watched(0, 10);
  axis.load(-1, 3);
  assert.deepEqual(axis.view, [-1, 3]);
  assert.ok(!axis.zoomed);
  assert.equal(told(), 0);
});
