// Drawings that follow the same hand: one in a frame, none lost, the one that waits longest first.
import assert from 'node:assert/strict';
import { beforeEach, test } from 'node:test';

/** @type {(() => void)[]} */ const frames = []; // that are asked for
Object.assign(globalThis, { requestAnimationFrame: (/** @type {() => void} */ act) => frames.push(act) });
const { inTurn } = await import('../../app/static/browser/turns.js');

/** @type {string[]} */ let drawn = [];
const picture = () => void drawn.push('picture');
const map = () => void drawn.push('map');

/** @param {number} most */
function shown(most) {
  const each = [];
  for (let k = 0; k < most && frames.length; k++) {
    drawn = [];
    for (const act of frames.splice(0)) act();
    each.push(drawn);
  }
  return each;
}

beforeEach(() => void shown(10));

test('two are drawn one after the other, each once', () => {
  for (const draw of [picture, map, picture, map, map]) inTurn(draw);
  assert.deepEqual(shown(10), [['picture'], ['map']]);
});

test('one that asks again, as long as the hand moves, leaves the next frame to the other', () => {
  let left = 3;
  const again = () => {
    picture();
    if (left--) inTurn(again);
  };
  inTurn(again);
  inTurn(map);
  assert.deepEqual(shown(10), [['picture'], ['map'], ['picture'], ['picture'], ['picture']]);
});

test('alone, it has every frame', () => {
  inTurn(picture);
  assert.deepEqual(shown(1), [['picture']]);
  inTurn(picture);
  assert.deepEqual(shown(10), [['picture']]);
});

test('one that fails takes no other with it', () => {
  const fails = () => {
    throw new Error('no picture');
  };
  inTurn(fails);
  inTurn(map);
  assert.throws(() => shown(1), /no picture/);
  assert.deepEqual(shown(10), [['map']]);
});
