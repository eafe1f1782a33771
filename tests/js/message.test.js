// The message of the server.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { arrayOf, decode, given } from '../../app/static/wire/message.js';

/** Pack a message as the server does: length, header, float32 arrays or whole numbers of two bytes. */
function packed(header, arrays) {
  const entries = arrays.map(([name, values, unit, shape]) => [
    name,
    shape ?? [values.length],
    ...(unit ? [unit] : []),
  ]);
  const text = JSON.stringify({ ...header, arrays: entries });
  const bytes = new TextEncoder().encode(text + ' '.repeat((4 - (text.length % 4)) % 4));
  const parts = arrays.map(([, values, unit]) => {
    const numbers = unit ? new Int16Array(values.length + (values.length % 2)) : new Float32Array(values.length);
    numbers.set(values);
    return Buffer.from(numbers.buffer);
  });
  const length = Buffer.alloc(4);
  length.writeUInt32LE(bytes.length);
  const whole = Buffer.concat([length, bytes, ...parts]);
  return whole.buffer.slice(whole.byteOffset, whole.byteOffset + whole.length);
}

test('header and arrays come out as they went in', () => {
  const found = decode(
    packed({ kind: 'axial', trip: 2 }, [
      ['exactMass', [1, -2.5, 3]],
      ['modalForce', [3, -4, 5], 0.5],
      ['exactEnd', [7]],
    ]),
  );
  assert.equal(found.kind, 'axial');
  assert.equal(found.trip, 2);
  assert.deepEqual([...found.exactMass], [1, -2.5, 3]);
  assert.deepEqual([...found.modalForce], [1.5, -2, 2.5]);
  assert.deepEqual([...found.exactEnd], [7]);
});

test('tables come flat, with their shape', () => {
  const found = decode(packed({ kind: 'axial' }, [['fieldStress', [1, 2, 3, 4, 5, 6], 0, [2, 3]]]));
  assert.deepEqual(found.shapes, { fieldStress: [2, 3] });
  assert.deepEqual([...found.fieldStress], [1, 2, 3, 4, 5, 6]);
});

test('contacts of a beam come in rows', () => {
  const found = decode(packed({ kind: 'beam' }, [['contacts', [0, 1, 2, 3, 4, 5, 6, 7], 0, [2, 4]]]));
  assert.deepEqual(found.contacts, [
    [0, 1, 2, 3],
    [4, 5, 6, 7],
  ]);
});

test('what a message must hold is asked for by name', () => {
  const found = decode(packed({ kind: 'axial' }, [['f0', [1]]]));
  assert.deepEqual([...arrayOf(found, 'f0')], [1]);
  assert.throws(() => arrayOf(found, 'g0'), /no g0/);
  assert.equal(given(0, 'step'), 0);
  assert.throws(() => given(null, 'step'), /no step/);
});
