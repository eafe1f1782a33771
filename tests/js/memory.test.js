// What kernels may take: time, which never changes an answer, and memory that is given back.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { URL } from 'node:url';
import { kernelsOf } from '../../app/static/wasm/kernels.js';

const MODULE = readFileSync(new URL('../../app/static/wasm/kernels.wasm', import.meta.url));
const LAW = { name: 'linear', constants: [1e6] };
const MODES = { frequencies: new Float64Array([100, 600, 1700]), atContact: new Float64Array([1, 1, 1]) };
const STRUCK = {
  ...{ mass: 1, rigidMass: Infinity, whole: Infinity, duration: 0, damping: 0 },
  march: { ...MODES, compliance: 0, mean: 1, longest: (2 * Math.PI) / 100, whole: null, duration: null, turns: false },
};
const bytes = (kernels) => kernels.memory.buffer.byteLength;

test('memory grows with a beam and is given back, after which answers are the same', async () => {
  const kernels = await kernelsOf(MODULE);
  const first = bytes(kernels);
  const answer = kernels.beam(STRUCK, LAW);
  assert.ok(answer);
  assert.ok(bytes(kernels) > 4 * first, `${bytes(kernels)} bytes`);
  await kernels.giveBack();
  assert.equal(bytes(kernels), first);
  assert.deepEqual(kernels.beam(STRUCK, LAW), answer);
});

test('figures alone take little memory, of a beam no more however long it is followed', async () => {
  const kernels = await kernelsOf(MODULE);
  assert.ok(kernels.beamFigures(STRUCK, LAW));
  const once = bytes(kernels);
  assert.ok(once < 2e6, `${once} bytes`);
  const { longest } = STRUCK.march;
  assert.ok(kernels.beamFigures({ ...STRUCK, duration: 30 * longest }, LAW));
  assert.equal(bytes(kernels), once);
  assert.ok(kernels.figures(1, 1, { name: 'rigid', constants: [] }, 0, 0));
  assert.ok(kernels.figures(1, 1, { name: 'linear', constants: [10] }, 0, 0));
  assert.ok(4 * bytes(kernels) < 40e6, `${bytes(kernels)} bytes, in each of four workers`);
});

test('a kernel is left when its time is over, at once if it is already, and what follows is the same', async (t) => {
  const kernels = await kernelsOf(MODULE);
  const answer = kernels.beam(STRUCK, LAW);
  let looks = 0;
  t.mock.method(performance, 'now', () => looks++);
  const all = kernels.within(Infinity, () => kernels.beam(STRUCK, LAW));
  assert.deepEqual(all, [answer, false]);
  const whole = looks;
  assert.ok(whole > 20, `${whole} looks at the clock`);
  const top = kernels.stack.value;
  for (const longest of [0, 1, 7, whole - 3]) {
    looks = 0;
    const found = kernels.within(longest, () => kernels.beam(STRUCK, LAW));
    assert.deepEqual([found, looks], [[null, true], longest + 2]);
    assert.equal(kernels.stack.value, top);
    assert.deepEqual(kernels.beam(STRUCK, LAW), answer);
  }
});

test('the time is that of all kernels of an answer', async (t) => {
  const kernels = await kernelsOf(MODULE);
  let looks = 0;
  t.mock.method(performance, 'now', () => looks++);
  const ask = () => [kernels.rod(1, 1), kernels.beam(STRUCK, LAW)];
  kernels.within(Infinity, () => kernels.rod(1, 1));
  const first = looks;
  looks = 0;
  assert.deepEqual(kernels.within(first + 5, ask), [null, true]);
  assert.equal(looks, first + 7);
});

test('what fails is said, and no time is left over for others', async () => {
  const kernels = await kernelsOf(MODULE);
  const fail = () => {
    throw new TypeError('other');
  };
  assert.throws(() => kernels.within(0, fail), TypeError);
  assert.ok(kernels.beam(STRUCK, LAW));
});
