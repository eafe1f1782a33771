// Kept solutions: which settings differ, what is compared, and how differences are said.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { comparedOf, difference, figuresOf, leastSaid, sentences, shareOf } from '../../app/static/compare/figures.js';
import { comparable, compares } from '../../app/static/compare/kinds.js';
import { differing, kindsOf, lineOf } from '../../app/static/form/settings.js';
import { COMPARED } from '../../app/static/kinds.js';
import { paragraphsOf } from '../../app/static/compare/summary.js';
import { text } from '../../app/static/text/catalogue.js';
import { verdictOf } from '../../app/static/compare/verdict.js';

compares(COMPARED);

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
    travelling: true,
  };
  const chosen = { scene: 'fixed-rod', mass_ratio: 1, speed: 1, law: 'rigid', modes: 50, restitution: 0.8, ...changed };
  const acting = ['scene', 'method', 'mass_ratio', 'speed', 'law', 'modes', 'restitution'];
  return {
    kind: 'axial',
    title: 'A rod',
    damps: false,
    rigid: chosen.law === 'rigid',
    exponent: changed.law === 'hertz' ? 1.5 : 1,
    speed: 1,
    trip: 1e-4,
    chosen,
    own: chosen,
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

test('a force that grows is explained by the law that does so, and by no other', () => {
  const hertz = { law: 'hertz' };
  const told = verdictOf(rod({ ...hertz, speed: 2 }, 2.3e4), rod(hertz), ['speed']);
  assert.match(told, /2\.3 times as much.*power 1\.2.*stiffer the deeper/s);
  assert.match(verdictOf(rod({ speed: 2 }, 2e4), rod(), ['speed']), /proportional: nothing/);
  assert.match(verdictOf(rod({ ...hertz, speed: 2 }, 2e4), rod(hertz), ['speed']), /waves set the force/);
  const strange = verdictOf(rod({ ...hertz, speed: 2 }, 3.2e4), rod(hertz), ['speed']);
  assert.match(strange, /power of 1\.68, which the contact law does not explain/);
  assert.doesNotMatch(strange, /stiffer the deeper/);
  const yielding = { ...rod({ ...hertz, speed: 2 }, 1.8e4), yields: true };
  assert.match(verdictOf(yielding, rod(hertz), ['speed']), /as this contact yields/);
});

test('the power of a law is the one that the message says, whatever its name', () => {
  const stiff = (/** @type {number} */ speed, /** @type {number} */ peak) => ({
    ...rod({ law: 'lee-wang', speed }, peak),
    exponent: 2.5,
  });
  const told = verdictOf(stiff(2, 2.69e4), stiff(1, 1e4), ['speed']);
  assert.match(told, /power 1\.43.*stiffer the deeper.*it would be 1\.4,/s);
  const own = { ...stiff(2, 2.69e4), kind: 'beam', law: { name: 'mine', yields: false, exponent: 2.5 } };
  const kept = { ...stiff(1, 1e4), kind: 'beam', law: own.law };
  for (const frame of [own, kept]) Object.assign(frame, { contacts: frame.exact.contacts, rods: undefined });
  assert.match(verdictOf(own, kept, ['speed']), /stiffer the deeper.*it would be 1\.4,/s);
});

test('peaks of different contacts are told as such, and the first contact is compared', () => {
  const beam = (/** @type {number} */ speed, /** @type {number[]} */ peaks) => ({
    ...{ ...rod({ speed, law: 'hertz' }), kind: 'beam', law: { yields: false, exponent: 1.5 }, rods: undefined },
    contacts: peaks.map((peak, k) => [k, k + 0.5, 1, peak]),
  });
  const told = verdictOf(beam(0.02, [19.84, 10.8, 33.4]), beam(0.01, [9.007, 10.3]), ['speed']);
  assert.match(told, /now in contact 3 and was in contact 2.*contact 1 is 2\.2 times.*power 1\.14/s);
});

test('a comparison of hammers says what changes, and first what was asked', () => {
  const heavy = verdictOf(rod({ mass_ratio: 0.25 }, 1.4e4), rod(), ['mass_ratio']);
  assert.match(heavy, /4 times the mass.*1\.4 times as hard.*as long as before: the force changes more/s);
  assert.doesNotMatch(heavy, /no constant/); // restitution is the same
  assert.doesNotMatch(verdictOf(rod({ mass_ratio: 0.25 }), rod(), ['mass_ratio']), /changes more/);
  const other = rod({ mass_ratio: 0.25 });
  other.exact = { ...other.exact, restitution: { newton: 0.96 } };
  const asked = verdictOf(other, rod(), ['mass_ratio'], 'constant');
  assert.match(asked, /^Restitution e is the speed.*0\.960 here instead of 0\.700.*no constant.*the hammer hits/s);
  assert.match(verdictOf(rod({ mass_ratio: 0.25 }), rod(), ['mass_ratio'], 'constant'), /^Restitution e.*in both/);
  assert.equal(verdictOf(rod({ speed: 2, law: 'hertz' }), rod(), ['speed', 'law']), '');
});

test('where a body turns about a pin the restitution is that of the struck points', () => {
  const beam = (/** @type {number} */ ratio, /** @type {number} */ points) => ({
    ...{ ...rod({ mass_ratio: ratio }), kind: 'beam', contacts: [[0, 1e-3, 1, 1e4]] },
    span: { apparent: 1e-3, real: 1e-3 },
    main: {
      ...{ contacts: 1, peakForce: 1e4, impulse: 1, energy: { initial: 1, target_vibration: 0.02 } },
      restitution: { newton: null, newton_at_contact: points },
    },
  });
  const told = verdictOf(beam(1, 0.9), beam(4, 0.2), ['mass_ratio'], 'constant');
  assert.match(told, /the struck points part.*0\.900 here instead of 0\.200.*still swings/s);
});

test('of numbers of modes it says which is enough for what', () => {
  const [now, kept] = [rod({ modes: 100 }), rod({ modes: 5 })];
  for (const frame of [now, kept]) frame.exact = { ...frame.exact, name: 'waves' };
  now.other = { ...now.other, peakForce: 1.02e4 };
  kept.other = { ...kept.other, peakForce: 0.6e4, contacts: [] };
  const told = verdictOf(now, kept, ['modes']);
  assert.match(told, /^For the last velocity 5 modes are enough.*contacts 100; the peak force does not settle/);
  assert.match(told, /5 modes miss.*by 40\.0\s%.*100 modes miss.*by 2\.00\s%/);
  assert.match(told, /for the number of contacts 100.*impulse and contacts\./);
  const soft = [now, kept].map((frame) => ({ ...frame, rigid: false }));
  assert.match(verdictOf(soft[0], soft[1], ['modes']), /for the peak force not even 100\./);
});

test('where a warning says not to trust the number of contacts, modes are judged by velocity and impulse', () => {
  const frames = [rod({ modes: 100 }), rod({ modes: 5 })].map((frame, k) => {
    const other = { ...frame.other, contacts: [[0, 1.5, k ? 3.01 : 3, 1e4]], notes: [{ code: 'near-grazing' }] };
    return { ...frame, exact: { ...frame.exact, name: 'waves', notes: [] }, other };
  });
  const told = verdictOf(frames[0], frames[1], ['modes']);
  assert.match(told, /^For the last velocity 5 modes are enough.*for the impulse 5.*contacts is no measure here/);
  assert.match(told, /judge by velocity, impulse\..*go by velocity and impulse\..*the impulse by 0\.33\s%/s);
  assert.doesNotMatch(told, /for the number of contacts|and contacts\./);
});

test('of a beam the larger number of modes judges the smaller, and says why', () => {
  const beam = (/** @type {number} */ modes, /** @type {number} */ peakForce) => ({
    ...{ ...rod({ modes }), kind: 'beam', contacts: [[0, 5e-4, 1, peakForce]] },
    modeFrequencies: Float64Array.from({ length: modes }, (_, k) => 2000 * Math.PI * (k + 1)),
    main: { ...{ name: 'modal', contacts: 1, final: -0.5, peakForce, impulse: 1, energy: { initial: 1 } } },
    ...{ time: [0, 1e-3], struckRate: [0, peakForce / 1e4] },
  });
  const told = verdictOf(beam(100, 1e4), beam(5, 1.005e4), ['modes']);
  assert.match(told, /velocity 5 modes are enough.*lasts 500\sµs, mode 5 swings in 200\sµs.*by up to 0\.50\s%/s);
  assert.match(verdictOf(beam(100, 2e4), beam(5, 1e4), ['modes']), /for the peak force more than 5\./);
});

test('only impacts of one kind and size are laid one upon the other', () => {
  const beam = { ...rod({ scene: 'beam' }), kind: 'beam', main: { peakForce: 1e4 } };
  assert.ok(!comparable(rod(), beam));
  assert.ok(comparable(rod(), rod({ scene: 'free-rod' }, 2e4)));
  assert.ok(!comparable(rod(), rod({ scene: 'two-balls' }, 2e1)));
  assert.ok(comparable(rod(), rod({ speed: 1e-3 }, 1e1))); // one scene
  const moved = { ...beam, kind: 'mechanism', chosen: { scene: 'four-bar' }, mechanism: { links: [] } };
  assert.ok(!comparable(beam, moved));
});

test('where figures are alike it says how far they lie apart', () => {
  const [now, kept] = [figuresOf(rod({}, 1.0029e4), 'exact'), figuresOf(rod(), 'exact')];
  assert.match(leastSaid(now, kept), /half a percent; peak force differs most, by 0\.29\s%/);
});

test('struck on its end a rod is felt as a quarter of its mass', () => {
  const struck = (/** @type {number} */ felt) => ({
    ...{ kind: 'bodies', acting: ['place'], chosen: {} },
    figures: Object.entries({ 'target-mass': 2, 'target-felt-mass': felt }).map(([name, value]) => [name, value, 'kg']),
  });
  const [now, kept] = /** @type {any[]} */ ([struck(0.5), struck(2)]);
  assert.match(verdictOf(now, kept, ['place']), /4 times as easily.*1\/m \+ 3\/m: it is felt as 0\.5\skg/s);
  assert.equal(verdictOf(kept, now, ['place']), '');
});

test('what one kept solution teaches the next does not say again, and all of another kind are told at once', () => {
  const runs = [0.9, 0.8, 0.7].map((restitution, k) => ({ letter: 'ABC'[k], asked: '', frame: rod({ restitution }) }));
  const told = paragraphsOf(rod({ restitution: 0.5 }), /** @type {any} */ (runs), null);
  assert.deepEqual(
    told.map(({ letters }) => letters),
    [['A'], ['B'], ['C']],
  );
  const repeated = told.flatMap(({ help, teaches }) => [help, teaches]).filter(Boolean);
  assert.equal(new Set(repeated).size, repeated.length);
  assert.ok(repeated.length);
  const speeds = [1, 2].map((speed, k) => ({ letter: 'AB'[k], asked: '', frame: rod({ speed }, speed * 1e4) }));
  const [first, second] = paragraphsOf(rod({ speed: 4 }, 4e4), /** @type {any} */ (speeds), null);
  assert.match(String(first.teaches), /^At 4 times the speed.*4 times as much\. Force and speed are proportional/);
  assert.equal(second.teaches, 'At 2 times the speed the largest force is 2 times as much.');
  const others = runs.map((run) => ({ ...run, frame: { ...run.frame, kind: 'beam' } }));
  const [apart, ...more] = paragraphsOf(rod(), /** @type {any} */ (others), null);
  assert.deepEqual([apart.letters, more], [['A', 'B', 'C'], []]);
  assert.match(apart.head, /A \(A rod\), B \(A rod\), C \(A rod\) are other kinds/);
});

test('a count that is none is not told', () => {
  assert.doesNotMatch(text('axial.resolution', { time: 1e-5, touches: 0 }), /touched/);
  assert.match(text('axial.resolution', { time: 1e-5, touches: 1 }), /touched once/);
});
