// What kernels may do: a bound of steps, which never changes an answer, and memory that is given back.
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

test('no kernel takes on more steps than its pace lets it, or does more than these', async () => {
  const free = await kernelsOf(MODULE);
  const answer = free.beam(STRUCK, LAW);
  const needed = free.array('beam', 'done', 1)[0];
  for (const share of [2, 1, 0.9, 0.3, 0.01]) {
    const bound = await kernelsOf(MODULE, 1);
    const steps = Math.floor(share * needed);
    bound.pace = () => (steps + 0.5) * (3 + 50);
    const found = bound.beam(STRUCK, LAW);
    assert.deepEqual(found, share >= 1 ? answer : null);
    assert.ok(bound.array('beam', 'done', 1)[0] <= steps);
    assert.ok(bytes(bound) < bytes(free), 'memory is for the steps that are allowed');
  }
});

test('a march is refused before it begins, waves when they have had what is allowed', async () => {
  const kernels = await kernelsOf(MODULE, 1);
  kernels.pace = () => 450 * 999; // a march is of a thousand steps at least
  assert.equal(kernels.modes(1, 1, LAW, 400, 1, 2, 'own'), null);
  assert.equal(kernels.array('modes', 'done', 1)[0], 0);
  kernels.pace = () => 450 * 10_000;
  assert.ok(kernels.modes(1, 1, LAW, 400, 1, 2, 'own'));
  kernels.pace = () => 2 * 5;
  const law = { name: 'linear', constants: [100, 0, 0, 0, 0, 0] };
  assert.equal(kernels.law(1, 1, law), null);
  assert.ok(kernels.array('law', 'done', 1)[0] <= 5);
  kernels.pace = () => Infinity;
  assert.ok(kernels.law(1, 1, law));
});

test('an answer that was slow is not the last one', async () => {
  const kernels = await kernelsOf(MODULE, 25);
  kernels.paces.beamlinear = [1, 1, 1]; // in a millisecond
  const tries = Array.from({ length: 5 }, () => kernels.beam(STRUCK, LAW));
  assert.equal(tries[0], null);
  assert.ok(tries.at(-1));
});
