// A class: lines with names and codes in whatever form, counts of answers, and a table that no spreadsheet takes amiss.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { numbersOf, placesOf, triesOf } from '../../app/static/classes/counts.js';
import { csvOf } from '../../app/static/classes/csv.js';
import { MOST, readLines } from '../../app/static/classes/lines.js';
import { codeOf } from '../../app/static/lesson/code.js';

const NUMBER = {
  ...{ kind: 'number', name: 'back', answer: 116.4, unit: 'µs', tolerance: 2.3 },
  ...{ units: ['s', 'ms', 'µs'], factors: [1, 1e-3, 1e-6] },
  mistakes: [
    { answer: 58.2, numbers: [], power_of_ten: false },
    { answer: null, numbers: [], power_of_ten: true },
  ],
};
const ORDER = { kind: 'order', name: 'story', items: [{}, {}, {}] };
const RECORD = {
  lesson: 'one',
  steps: [{ parts: [{ kind: 'choice', name: 'q', options: [{}, {}] }] }, { parts: [NUMBER] }],
};
const given = { q: { picked: 1 }, back: { value: -58.2, unit: 'µs', tries: 2, right: true } };
const CODE = codeOf(RECORD, given, 5);

test('a name may stand before a code, which may be broken up', () => {
  const forms = {
    [CODE]: '',
    [`Ann ${CODE}`]: 'Ann',
    [`Doe, Jane,${CODE}`]: 'Doe, Jane',
    [`Müller\t${CODE.toLowerCase()}`]: 'Müller',
    [`Mark ${CODE.replaceAll('-', ' ')}`]: 'Mark',
    [`"Ann B.","${CODE}"`]: 'Ann B.',
    [`Félix: ${CODE}`]: 'Félix',
    [`12; ${CODE.replaceAll('-', '- ')}  `]: '12',
  };
  for (const [line, name] of Object.entries(forms)) {
    const { rows, unread } = readLines(RECORD, `\n${line}\r\n\n`);
    assert.deepEqual([unread, rows.length], [[], 1], line);
    assert.deepEqual([rows[0].line, rows[0].name, rows[0].code, rows[0].given], [2, name, CODE, given], line);
  }
});

test('why a line is not read', () => {
  const why = (line) => readLines(RECORD, line).unread.map((each) => each.why + each.sign);
  assert.deepEqual(why('Ben BCDF-GHJK'), ['short']);
  assert.deepEqual(why('just words'), ['short']);
  assert.deepEqual(why(`Ben ${CODE.slice(0, -1)}E`), ['signE']);
  assert.deepEqual(why(`Ben ${CODE.slice(0, -1)}${CODE.endsWith('B') ? 'C' : 'B'}`), ['check']);
  assert.deepEqual(why(codeOf({ ...RECORD, lesson: 'two' }, given, 5)), ['other']);
  assert.deepEqual(why(`A ${CODE}\nB ${CODE}`), ['twice']);
  const { beyond, unread } = readLines(RECORD, 'x\n'.repeat(MOST + 2));
  assert.deepEqual([beyond, unread.length], [2, MOST]);
});

test('numbers are counted by size, the usual mistakes and others apart', () => {
  const first = (value, unit = 'µs') => ({ value, unit, tries: 1, right: true });
  const all = [first(116), first(0.1164, 'ms'), first(58), first(116.4, 's'), first(12.3), first(12.34), first(500)];
  assert.deepEqual(
    numbersOf(NUMBER, all).map(({ count, mistake, right, value }) => [value, right, mistake, count]),
    [
      [12, false, -1, 2],
      [58.2, false, 0, 1],
      [116.4, true, -1, 2],
      [500, false, -1, 1],
      [null, false, 1, 1],
    ],
  );
  const odd = Array.from({ length: 12 }, (_, k) => first(200 + 10 * k));
  const found = numbersOf(NUMBER, odd);
  assert.deepEqual([found.at(-1).count, found.at(-1).value, found.length], [4, null, 12]);
  assert.deepEqual(triesOf([first(1), { tries: 3, right: true }, { tries: 2, right: false }]), {
    ...{ first: 1, later: 1, never: 1 },
  });
});

test('of an order it is counted what is in its place, and where else it is put most', () => {
  const all = [
    [0, 1, 2],
    [1, 0, 2],
    [1, 2, 0],
  ].map((order) => ({ order }));
  assert.deepEqual(placesOf(ORDER, all), [
    { count: 1, instead: 1, most: 1 },
    { count: 1, instead: 0, most: 2 },
    { count: 2, instead: 1, most: 1 },
  ]);
});

test('a table is quoted, and no name is a formula in it', () => {
  const names = ['=SUM(A1)', '+1', '-1', '@x', 'a "b", c', '\t=1', 'Ann'];
  const rows = names.map((name, k) => ({ line: k + 1, name, code: CODE, given: { ...given, q: k ? given.q : null } }));
  const lines = csvOf(RECORD, rows).split('\r\n');
  assert.equal(lines[0], '\ufeff"name","code","q","back","back.unit","back.tries","back.right"');
  assert.equal(lines[1], `"'=SUM(A1)","${CODE}","","-58.2","µs","2","true"`);
  assert.equal(lines[2], `"'+1","${CODE}","2","-58.2","µs","2","true"`);
  assert.deepEqual(
    lines.slice(3, 8).map((line) => line.split(`,"${CODE}`)[0]),
    [`"'-1"`, `"'@x"`, '"a ""b"", c"', `"'\t=1"`, '"Ann"'],
  );
});
