// Colours of maps, curves and tolerances without their hue: in light and dark.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { RAMPS } from '../../app/static/whatif/colours.js';
import { BANDS } from '../../app/static/whatif/curves.js';
import { TONES } from '../../app/static/whatif/histogram.js';
import { COLOR } from '../../app/static/whatif/ink.js';

const TURNED = [[-0.574, 1.43, 0.144], [0.426, 0.43, 0.144], [0.426, 1.43, -0.856]]; // prettier-ignore
const colourOf = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16) / 255);
/** As the dark scheme turns it over: invert(0.93) hue-rotate(180deg). */
const dark = (colour) => {
  const turned = colour.map((part) => 0.93 - 0.86 * part);
  const rows = TURNED.map((row) => row.reduce((sum, m, k) => sum + m * turned[k], 0));
  return rows.map((part) => Math.min(Math.max(part, 0), 1));
};
const luminance = (colour) => {
  const [r, g, b] = colour.map((v) => (v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
};
const contrast = (one, other) => {
  const [low, high] = [luminance(one), luminance(other)].sort((a, b) => a - b);
  return (high + 0.05) / (low + 0.05);
};
const SCHEMES = { light: (colour) => colour, dark };

test('a higher value is darker throughout in the light scheme, and lighter in the dark one', () => {
  for (const [name, ramp] of Object.entries(RAMPS)) {
    const [light, turned] = Object.values(SCHEMES).map((scheme) => ramp.map((hex) => luminance(scheme(colourOf(hex)))));
    for (let k = 1; k < ramp.length; k++)
      assert.ok(light[k] < light[k - 1] && turned[k] > turned[k - 1], `${name} ${k}`);
    const ends = [0, ramp.length - 1].map((k) => colourOf(ramp[k]));
    assert.ok(contrast(...ends) > 10 && contrast(...ends.map(dark)) > 8, name);
  }
});

test('numbers of contacts that follow each other differ in lightness', () => {
  for (const [scheme, shown] of Object.entries(SCHEMES))
    for (const [least, colours] of [[1.5, RAMPS.steps], [1.5, TONES], [1.18, BANDS]]) // prettier-ignore
      colours.slice(1).forEach((hex, k) => {
        const found = contrast(shown(colourOf(hex)), shown(colourOf(colours[k])));
        assert.ok(found >= least, `${scheme} ${colours[k]} ${hex} ${found}`);
      });
});

test('the number that stands in a band can be read', () => {
  for (const shown of Object.values(SCHEMES))
    for (const band of BANDS) assert.ok(contrast(shown(colourOf(band)), shown(colourOf(COLOR.ink))) >= 4.5, band);
});
