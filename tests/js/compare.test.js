// Kept solutions: which settings differ, what is compared, and how differences are said.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { comparedOf, difference, figuresOf, sentences, shareOf } from '../../app/static/compare/figures.js';
import { questionsOf } from '../../app/static/compare/questions.js';
import { differing, kindsOf, lineOf } from '../../app/static/compare/settings.js';
import { verdictOf } from '../../app/static/compare/verdict.js';

/**
 * As much of a message as is compared.
 * @param {Record<string, number | string>} changed
 * @param {number} [peakForce]
 * @returns {any}
 */
const rod = (changed = {}, peakForce = 1e4) => {
  const told = {
    contacts: [[0, 1.5, 3, peakForce]],
    peakForce,
    final: -0.7,
    restitution: { newton: 0.7 },
    energy: { initial: 2, target_vibration: 1 },
  };
  const chosen = { scene: 'fixed-rod', mass_ratio: 1, speed: 1, law: 'rigid', modes: 50, restitution: 0.8, ...changed };
  const acting = ['scene', 'method', 'mass_ratio', 'speed', 'law', 'modes', 'restitution'];
  return {
    kind: 'axial',
    title: 'A rod',
    damps: false,
    speed: 1,
    trip: 1e-4,
    chosen,
    acting,
    exact: told,
    other: told,
    rods: [{}],
  };
};

test('settings that differ, in words', () => {
  const [now, kept] = [rod({ speed: 2, law: 'hertz' }), rod()];
  const names = differing([now, kept]);
  assert.deepEqual(names, ['speed', 'law']);
  assert.equal(lineOf(names, now), '2 m/s, Hertz');
  assert.equal(lineOf(names, kept), '1 m/s, Rigid');
});

test('a setting that acts on neither does not differ', () => {
  const [now, kept] = [rod({ linear_stiffness: 1 }), rod({ linear_stiffness: 2 })];
  assert.deepEqual(differing([now, kept]), []);
});

test('where only the way of solving differs, the other method is compared', () => {
  assert.deepEqual(kindsOf(rod({ modes: 5 }), rod()), { impact: false, how: true });
  assert.equal(comparedOf(rod({ modes: 5 }), rod()), 'other');
  assert.equal(comparedOf(rod({ modes: 5, speed: 2 }), rod()), 'exact');
  assert.equal(comparedOf(rod({ restitution: 0.5 }), rod()), 'other'); // no contact loses anything: of a prediction
});

test('differences in percent and in words', () => {
  const [now, kept] = [figuresOf(rod({}, 1.1e4), 'exact'), figuresOf(rod(), 'exact')];
  assert.equal(difference(now[0], kept[0]), '+10 %');
  assert.equal(difference(kept[0], kept[0]), '=');
  assert.deepEqual(sentences(now, kept), [
    'peak force 11 kN instead of 10 kN: 10 % more'.replaceAll(/ (?=kN|%|more)/g, '\u00a0'),
  ]);
  const [many] = figuresOf(rod({}, 3e4), 'exact');
  assert.match(sentences([many], kept)[0], /: 3\stimes as much$/);
});

test('a share of nothing, or of another sign, is none', () => {
  const of = (/** @type {number | null} */ value) => ({
    key: 'x',
    name: 'x',
    size: /** @type {const} */ ('number'),
    value,
  });
  assert.equal(shareOf(of(1), of(0)), null);
  assert.equal(shareOf(of(1), of(-1)), null);
  assert.equal(shareOf(of(null), of(1)), null);
  assert.equal(shareOf(of(0), of(0)), 0);
});

test('only what acts is asked, and nothing that changes nothing', () => {
  assert.deepEqual(
    questionsOf(rod()).map(({ key }) => key),
    ['modes', 'law', 'hammer', 'constant', 'speed', 'support', 'quarter'],
  );
  assert.ok(!questionsOf(rod({ speed: 100 })).some(({ key }) => key === 'speed'));
});

test('a comparison of one setting says what it teaches', () => {
  const soft = { ...rod({ speed: 2 }, 2.3e4) };
  assert.match(verdictOf(soft, rod(), ['speed']), /2\.3 times as much.*power 1\.2/s);
  assert.match(verdictOf(rod({ speed: 2 }, 2e4), rod(), ['speed']), /proportional/);
  const heavy = verdictOf(rod({ mass_ratio: 0.25 }, 1.4e4), rod(), ['mass_ratio']);
  assert.match(heavy, /4 times the mass.*1\.4 times as hard.*1 times as long.*force changes more/s);
  assert.doesNotMatch(heavy, /no constant/); // restitution is the same
  assert.equal(verdictOf(rod({ speed: 2, law: 'hertz' }), rod(), ['speed', 'law']), '');
});

test('of numbers of modes it says how far each is from the exact solution', () => {
  const [now, kept] = [rod({ modes: 100 }), rod({ modes: 5 })];
  now.other = { ...now.other, peakForce: 1.02e4 };
  kept.other = { ...kept.other, peakForce: 0.6e4 };
  assert.match(verdictOf(now, kept, ['modes']), /10 kN, in one contact: 5 modes miss it by 40\.0 %, 100 by 2\.00 %/);
});

test('struck on its end a rod is felt as a quarter of its mass', () => {
  const struck = (/** @type {number} */ felt) => ({
    ...{ kind: 'bodies', acting: ['place'], chosen: {} },
    figures: Object.entries({ 'target-mass': 2, 'target-felt-mass': felt }).map(([name, value]) => [name, value, 'kg']),
  });
  const [now, kept] = /** @type {any[]} */ ([struck(0.5), struck(2)]);
  assert.match(verdictOf(now, kept, ['place']), /4 times as easily.*1\/m \+ 3\/m: it is felt as 0\.5 kg/s);
  assert.equal(verdictOf(kept, now, ['place']), '');
});
