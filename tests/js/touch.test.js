// The circle of contact in words.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { touchAt } from '../../app/static/axial/touch.js';

const said = (...given) => touchAt(...given).replaceAll('\u00a0', ' ');
const TOUCH = { touchTime: [0, 1e-4, 2e-4], touchRadius: [0, 2e-4, 0], touchPressure: [0, 1.2e9, 0] };

test('a circle and the pressure on it are said while the bodies touch', () => {
  assert.equal(said(TOUCH, 0.5e-4), 'circle a = 100 µm   p₀ = 600 MPa');
  assert.equal(said({ ...TOUCH, touchFlow: [0, 2.4, 0] }, 1e-4), 'circle a = 200 µm   p = 1.2 GPa = 2.4 σ_Y');
  for (const time of [0, 2e-4, 1]) assert.equal(touchAt(TOUCH, time), '');
  assert.equal(touchAt({}, 1e-4), '');
});
