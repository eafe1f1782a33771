// Changes on their way to the server: one at a time.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { clearTimeout } from 'node:timers';
import { Changes } from '../../app/static/wire/changes.js';

Object.assign(globalThis, { window: globalThis });

/** @param {Record<string, any>} chosen */
const frame = (chosen) => /** @type {any} */ ({ chosen });

test('the next change waits for the answer to the last, not for a frame that crosses it', () => {
  /** @type {any} */
  const model = { speed: 1 };
  const changes = new Changes({ model, lost: () => false, sent: () => {}, kept: () => {} });
  changes.set('speed', 2);
  changes.set('speed', 3);
  assert.equal(model.speed, 2);
  assert.equal(changes.answers(frame({ speed: 1 })), false, 'a draft of the value before, refined');
  assert.equal(changes.answers(frame({ speed: 2 })), true);
  changes.settle();
  assert.equal(model.speed, 3);
  clearTimeout(changes.patience);
});

test('a value that the server has changed is answered as it is then', () => {
  /** @type {any} */
  const model = { support: 'free', place: 1 };
  const changes = new Changes({ model, lost: () => false, sent: () => {}, kept: () => {} });
  changes.set('place', 0.2);
  model.place = 0.25;
  assert.equal(changes.answers(frame({ place: 0.25 })), true);
  clearTimeout(changes.patience);
});

test('while a hand moves what is answered on the spot, an answer that comes sends nothing', () => {
  /** @type {any} */
  const model = { speed: 1 };
  const changes = new Changes({ model, lost: () => false, sent: () => {}, kept: () => {} });
  changes.set('speed', 2);
  changes.set('speed', 3, () => 1000);
  changes.settle();
  assert.equal(model.speed, 2, 'the hand has not come to rest');
  changes.set('speed', 4);
  assert.equal(model.speed, 4, 'a change that is not answered on the spot');
  clearTimeout(changes.patience);
});
