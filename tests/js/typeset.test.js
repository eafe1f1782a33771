// Formulas with raised and lowered letters.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { partsOf, spoken, withSigns } from '../../app/static/text/typeset.js';

/** @param {string} words */
const html = (words) =>
  partsOf(words)
    .map(({ text, kind, beside }) => (kind ? `${text}<${kind}>${beside}</${kind}>` : text))
    .join('');

test('letters are lowered and raised, and keys of scene files left alone', () => {
  const cases = {
    'F = K_h α¹·⁵': 'F = K<sub>h</sub> α¹·⁵',
    'v (1 + e^(-2 β)) and (1 + β/3)^-1/2': 'v (1 + e<sup>-2 β</sup>) and (1 + β/3)<sup>-1/2</sup>',
    'Yield σ_Y, x^n': 'Yield σ<sub>Y</sub>, x<sup>n</sup>',
    'contact.yield_indentation, end_mass, hertz_stiffness': 'contact.yield_indentation, end_mass, hertz_stiffness',
  };
  for (const [given, shown] of Object.entries(cases)) assert.equal(html(given), shown);
  assert.equal(spoken('Yield σ_Y'), 'Yield σY');
});

test('formulas of scene files have their signs', () => {
  const cases = {
    'grows as a^2 = 2 alpha R': 'grows as a² = 2 α R',
    'A v sqrt(E rho), omega^2 = omega_0^2': 'A v √(E ρ), ω² = ω_0²',
    '6.92e9 N/m^1.5, e^(-2 beta), (1 + beta/3)^-1/2': '6.92e9 N/m¹·⁵, e^(-2 β), (1 + β/3)^-1/2',
    'a pin, a piston, alphabet': 'a pin, a piston, alphabet',
  };
  for (const [given, shown] of Object.entries(cases)) assert.equal(withSigns(given), shown);
});
