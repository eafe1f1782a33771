// Numbers as the page writes them.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import * as format from '../../app/static/text/format.js';

/** Cases of one function: arguments and what is written. */
const cases = {
  figures: [
    [[1234.5], '1230'],
    [[-0.0012345], '−0.00123'],
    [[1234.5, 2], '1200'],
    [[1e-13], '0'],
  ],
  pretty: [
    [[0], '0'],
    [[1234.56], '1235'],
    [[0.00012], '1.2e-4'],
    [[-2.5e10], '-2.5e10'],
  ],
  brief: [
    [[0], '0'],
    [[-1234.5], '−1230'],
    [[1e6], '1.00e+6'],
    [[0.0001], '1.00e−4'],
  ],
  signed: [
    [[-0.6989, 3], '−0.699'],
    [[-0.0001, 3], '0.000'],
    [[2, 1], '2.0'],
  ],
  percent: [
    [[0.5], '50.0 %'],
    [[0.0174], '1.74 %'],
  ],
  share: [
    [[0], '0 %'],
    [[1e-9], '< 10⁻⁵ %'],
    [[0.0123], '1.2 %'],
    [[11], '> 1000 %'],
  ],
  raised: [
    [[-12], '⁻¹²'],
    [[3], '³'],
  ],
  decade: [
    [[-2], '0.01'],
    [[3], '1000'],
    [[-6], '10⁻⁶'],
  ],
  percentDecade: [
    [[-2], '1 %'],
    [[-7], '10⁻⁵ %'],
  ],
  powered: [
    [['of 1.9e+10 N/m or 1e-05'], 'of 1.9·10¹⁰ N/m or 10⁻⁵'],
    [['nothing of 3.5 m'], 'nothing of 3.5 m'],
  ],
  duration: [
    [[0], '0 s'],
    [[1.23e-5], '12.3 µs'],
    [[0.00408], '4.08 ms'],
    [[1.5], '1.5 s'],
  ],
  length: [
    [[12e-6], '12 µm'],
    [[0.0021], '2.1 mm'],
  ],
  engineering: [
    [[2.351e-6, 's'], '2.35 µs'],
    [[4e-10, 's'], '0.4 ns'],
    [[0.5, 's'], '500 ms'],
    [[0.0009996, 's'], '1 ms'],
    [[-78345, 'N'], '−78.3 kN'],
    [[0, 's'], '0 s'],
  ],
};

for (const [name, each] of Object.entries(cases))
  test(`${name} writes`, () => {
    for (const [given, written] of each) assert.equal(format[name](...given), written);
  });

test('units get the prefix that suits their size', () => {
  assert.deepEqual(format.prefixed(5e6), [1e-6, 'M']);
  assert.deepEqual(format.prefixed(4000), [1e-3, 'k']);
  assert.deepEqual(format.prefixed(0.2), [1e3, 'm']);
  assert.deepEqual(format.prefixed(0), [1, '']);
  assert.deepEqual(format.scaled(7.8e4, 'N'), [1e-3, 'kN']);
  assert.deepEqual(format.scaled(1.5, 'm'), [1, 'm']);
  assert.deepEqual(format.scaled(0.01, 'm'), [1e3, 'mm']);
  assert.deepEqual(format.scaled(2e-5, 'm'), [1e6, 'µm']);
  assert.deepEqual(format.scaled(1e-9, 'm'), [1e9, 'nm']);
  assert.deepEqual(format.scaled(3e5, 'm/s'), [1, 'm/s']);
});
