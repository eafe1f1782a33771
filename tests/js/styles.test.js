// Colours of stress beside their ground, in light and dark.
import assert from 'node:assert/strict';
import { test } from 'node:test';

const MORE = 1.6; // times as much lightness, as the glare on a screen takes most from what is dark

/** @typedef {[red: number, green: number, blue: number]} Colour  from 0 to 1 */

/**
 * As the dark scheme turns colours over: invert(0.93) hue-rotate(180deg).
 * @param {Colour} colour
 * @returns {Colour}
 */
function turned(colour) {
  const [r, g, b] = colour.map((part) => 0.93 - 0.86 * part);
  const mixed = [-0.574 * r + 1.43 * g + 0.144 * b, 0.426 * r + 0.43 * g + 0.144 * b, 0.426 * r + 1.43 * g - 0.856 * b];
  return /** @type {Colour} */ (mixed.map((part) => Math.min(Math.max(part, 0), 1)));
}

/**
 * Lightness as eyes have it, L* of CIE 1976, from 0 to 100.
 * @param {Colour} colour
 */
function lightness(colour) {
  const [r, g, b] = colour.map((v) => (v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
  const luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
  return luminance > 0.00886 ? 116 * Math.cbrt(luminance) - 16 : 903.3 * luminance;
}

/**
 * By how much lightness a stress stands out from its ground, in one scheme.
 * @param {boolean} dark
 * @param {number} share  of the largest stress
 */
async function standsOut(dark, share) {
  Object.assign(globalThis, { matchMedia: () => ({ matches: dark }) });
  const { palette, shade } = await import(`../../app/static/charts/styles.js?dark=${dark}`);
  const seen = (/** @type {Colour} */ colour) => (dark ? turned(colour) : colour);
  const k = shade(share, 1);
  const colour = /** @type {Colour} */ (Array.from(palette.slice(k, k + 3), (part) => part / 255));
  return Math.abs(lightness(seen(colour)) - lightness(seen([1, 1, 1])));
}

for (const share of [0.1, 0.2, 0.4, -0.1, -0.2, -0.4])
  test(`a stress of ${share} of the largest stands out in the dark as in the light`, async () => {
    const [light, dark] = [await standsOut(false, share), await standsOut(true, share)];
    assert.ok(dark > MORE * light);
  });
