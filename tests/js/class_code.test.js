// Codes of students: all that was answered comes back, whatever it is; nothing that was mistyped or changed is read.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import {
  codeOf,
  CodeError,
  LETTERS,
  MOST_TRIES,
  OUTCOMES,
  POINTS,
  questionsOf,
  readCode,
  SALTS,
  shareOf,
  givenOf,
} from '../../app/static/lesson/code.js';

const many = (count) => Array.from({ length: count }, () => ({}));
const SKETCH = { kind: 'sketch', name: 'force', axis: [-20, 100], until: 'part-2' };
const RECORD = {
  lesson: 'bounce',
  steps: [
    { parts: [{ kind: 'text' }, { kind: 'choice', name: 'next', options: many(3) }] },
    { parts: [{ ...SKETCH, judges: Object.keys(OUTCOMES).map((criterion) => ({ criterion })) }] },
    { parts: [{ kind: 'set', name: 'once', range: [0.34, 10], found: many(2) }] },
    { parts: [{ kind: 'number', name: 'back', units: ['s', 'ms', 'µs'] }, { kind: 'after' }] },
    { parts: [{ kind: 'order', name: 'story', items: many(6) }] },
    { parts: [{ kind: 'summary' }] },
  ],
};
const NONE = { next: null, force: null, once: null, back: null, story: null };
const ANSWERED = {
  next: { picked: 1 },
  force: null,
  once: { places: [null, 0.45] },
  back: { value: 58.2, unit: 'µs', tries: 2, right: true },
  story: { order: [0, 2, 1, 3, 5, 4], tries: 3, right: true },
};

/** A sequence of numbers below 1, always the same. */
function* shuffled(state = 1) {
  for (;;) {
    state = (Math.imul(state, 1103515245) + 12345) >>> 0;
    yield state / 2 ** 32;
  }
}
const numbers = shuffled();
const below = (count) => Math.floor(numbers.next().value * count);

const tried = () => ({ tries: 1 + below(MOST_TRIES), right: below(2) > 0 });
const ANY = {
  choice: ({ options }) => ({ picked: below(options.length) }),
  set: ({ found }) => ({
    places: found.map((_, k) => (k && below(2) ? null : 0.34 * (10 / 0.34) ** numbers.next().value)),
  }),
  number: ({ units }) => ({
    value: Number(((below(2) ? 1 : -1) * 10 ** (below(20) - 10) * numbers.next().value).toPrecision(4)),
    unit: units[below(units.length)],
    ...tried(),
  }),
  order: ({ items }) => {
    const left = [...items.keys()];
    return { order: items.map(() => left.splice(below(left.length), 1)[0]), ...tried() };
  },
  sketch: ({ judges }) => ({
    outcomes: judges.map(({ criterion }) => OUTCOMES[criterion][below(OUTCOMES[criterion].length)]),
    late: below(2) > 0,
    line: Array.from({ length: POINTS }, () => -20 + 4 * below(31)),
  }),
};
const any = () =>
  Object.fromEntries(questionsOf(RECORD).map((part) => [part.name, below(5) ? ANY[part.kind](part) : null]));
const why = (code, record = RECORD) => {
  try {
    readCode(record, code);
  } catch (error) {
    assert.ok(error instanceof CodeError);
    return error.why;
  }
  return '';
};

test('whatever was answered comes back', () => {
  for (let k = 0; k < 400; k++) {
    const given = any();
    const found = readCode(RECORD, codeOf(RECORD, given, below(SALTS)));
    const { once, ...others } = given;
    const { once: places, ...rest } = found;
    assert.deepEqual(rest, others);
    assert.equal(Boolean(places), Boolean(once));
    once?.places.forEach((place, n) => {
      assert.equal(places.places[n] === null, place === null);
      const off = place === null ? 0 : shareOf(place, [0.34, 10]) - shareOf(places.places[n], [0.34, 10]);
      assert.ok(Math.abs(off) < 0.012);
    });
  }
});

test('a code has groups of four letters, without a sketch six, and no vowel', () => {
  const code = codeOf(RECORD, ANSWERED, 17);
  assert.match(code, /^([B-DF-HJ-NP-TW-XZ]{4}-){5}[B-DF-HJ-NP-TW-XZ]{4}$/);
  assert.ok(codeOf(RECORD, NONE, 0).length <= 24);
  assert.ok(codeOf(RECORD, { ...any(), force: ANY.sketch(questionsOf(RECORD)[1]) }, 0).length <= 75);
  assert.equal(new Set(LETTERS).size, 19);
});

test('it may be written in small letters, and with other room between them', () => {
  const code = codeOf(RECORD, ANSWERED, 17);
  const { once, ...others } = ANSWERED;
  for (const written of [code, code.toLowerCase(), code.replaceAll('-', ' '), code.replaceAll('-', ''), ` ${code} `]) {
    const { once: places, ...rest } = readCode(RECORD, written);
    assert.deepEqual(rest, others);
    assert.equal(once.places[1].toFixed(1), places.places[1].toFixed(1));
  }
});

test('the same answers have other codes, of which no part but the first letter need be the same', () => {
  const codes = Array.from({ length: 200 }, (_, k) => codeOf(RECORD, ANSWERED, k * 34));
  assert.equal(new Set(codes).size, 200);
  assert.ok(new Set(codes.map((code) => code.slice(-4))).size > 190);
  assert.ok(new Set(codes.map((code) => code.slice(10, 14))).size > 190);
});

test('each wrong letter, each two neighbours that change places, and letters left out or added are found', () => {
  for (const given of [ANSWERED, NONE, any(), any()]) {
    const code = codeOf(RECORD, given, below(SALTS)).replaceAll('-', '');
    assert.equal(why(code), '');
    for (let k = 0; k < code.length; k++) {
      for (const letter of LETTERS)
        if (letter !== code[k]) assert.equal(why(code.slice(0, k) + letter + code.slice(k + 1)), 'check');
      const [a, b] = code.slice(k, k + 2);
      if (b && a !== b) assert.equal(why(code.slice(0, k) + b + a + code.slice(k + 2)), 'check');
      assert.match(why(code.slice(0, k) + code.slice(k + 1)), /check|short/);
      assert.equal(why(code.slice(0, k) + LETTERS[below(19)] + code.slice(k)), 'check');
    }
  }
});

test('two wrong letters are found, too', () => {
  const code = [...codeOf(RECORD, ANSWERED, 5).replaceAll('-', '')];
  for (let n = 0; n < 3000; n++) {
    const changed = code.slice();
    const [k, l] = [below(code.length), below(code.length)];
    for (const place of [k, l]) changed[place] = LETTERS[below(19)];
    assert.equal(why(changed.join('')), changed.join() === code.join() ? '' : 'check');
  }
});

test('codes of another lesson, of other questions, and what is none are refused for what they are', () => {
  const code = codeOf(RECORD, ANSWERED, 99);
  assert.equal(why(code, { ...RECORD, lesson: 'other' }), 'other');
  assert.equal(why(code, { ...RECORD, steps: RECORD.steps.slice(1) }), 'other');
  assert.equal(why('hello'), 'short');
  assert.equal(why(''), 'short');
  assert.equal(why(code.replace(code[0], 'A')), 'sign');
  assert.equal(why('BCDF-BCDF-BCDF-BCDF'), 'check');
});

test('what the browser keeps of a lesson is given: first tries, and what was judged', () => {
  const line = [null, ...Array(130).fill(10), ...Array(130).fill(60)];
  const answers = {
    next: { picked: 2, done: false },
    force: { line, done: true, late: true, outcomes: [{ outcome: 'yes' }, { outcome: 'no' }, { outcome: 'late' }] },
    once: { place: 3, found: [{ which: 1, place: 0.4 }], done: true },
    back: { written: '116', unit: 'µs', tries: 2, done: true, said: -1, first: { value: 58, unit: 'ms' } },
    story: { order: [0, 1], tries: 0, checked: false, done: false },
  };
  const given = givenOf(RECORD, answers);
  assert.deepEqual([given.next, given.story], [null, null]);
  assert.deepEqual(given.once, { places: [null, 0.4] });
  assert.deepEqual(given.back, { value: 58, unit: 'ms', tries: 2, right: true });
  assert.deepEqual([given.force.outcomes, given.force.late], [['yes', 'no', 'late'], true]);
  assert.deepEqual([given.force.line[0], given.force.line[11], given.force.line[23]], [10, 10, 60]);
  assert.deepEqual(givenOf(RECORD, {}), NONE);
});
