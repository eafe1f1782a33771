import process from 'node:process';
// A class: lines with names and codes in whatever form, counts of answers, and a table that no spreadsheet takes amiss.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { numbersOf, placesOf, triesOf } from '../../app/static/classes/counts.js';
import { csvOf, whoOf } from '../../app/static/classes/csv.js';
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

const number = (value) => ({ q: { picked: 0 }, back: { value, unit: 'µs', tries: 1, right: false } });
const CODES = [CODE, codeOf(RECORD, number(3), 11), codeOf(RECORD, number(4), 12)];

test('all codes of a line are read, each with the name before it', () => {
  const [one, two, three] = CODES;
  const forms = {
    [`${one} ${two}`]: ['', ''],
    [`${one}, ${two}; ${three}`]: ['', '', ''],
    [`${one}|${two}/${three}`]: ['', '', ''],
    [`Ann: ${one}, Ben O'Hara - ${two.replaceAll('-', ' ')} "Doe, C." ${three}`]: ['Ann', "Ben O'Hara", 'Doe, C.'],
    [Array.from({ length: 30 }, (_, k) => `N${k} ${codeOf(RECORD, number(5), 20 + k)}`).join(' ')]: Array.from(
      { length: 30 },
      (_, k) => `N${k}`,
    ),
  };
  for (const [line, names] of Object.entries(forms)) {
    const { rows, unread } = readLines(RECORD, line);
    assert.deepEqual([unread, rows.map(({ name }) => name)], [[], names], line);
    assert.ok(rows.every((row) => row.line === 1));
  }
  const found = readLines(RECORD, CODES.join(' ')).rows;
  assert.deepEqual(
    found.map(({ code, given: { back } }) => [code, back.value]),
    [
      [one, -58.2],
      [two, 3],
      [three, 4],
    ],
  );
});

test('what of a line cannot be read is said, and no name is made of it', () => {
  const [one, two, three] = CODES;
  const wrong = `${two.slice(0, -1)}E`;
  const swapped = two.slice(0, 5) + two[6] + two[5] + two.slice(7);
  const read = (line) => {
    const { rows, unread } = readLines(RECORD, line);
    return [rows.map(({ name }) => name), unread.map((each) => each.words + each.why + each.sign)];
  };
  assert.notEqual(two[5], two[6]);
  assert.deepEqual(read(`Ann ${one} Ben ${wrong} Carl ${three}`), [
    ['Ann', 'Carl'],
    [`Ben ${wrong}`.slice(0, 40) + 'signE'],
  ]);
  assert.deepEqual(read(`${swapped} Ben ${three}`), [['Ben'], [`${swapped}check`]]);
  assert.deepEqual(read(`Ann ${one} Ben ${swapped}`), [['Ann'], [`Ben ${swapped}check`]]);
  assert.deepEqual(read(`Ann ${one} 8 b`), [['Ann'], ['8 bwords']]);
  assert.deepEqual(read(`${one} ${one}`), [[''], [`${one} ${one}`.slice(0, 40) + 'twice']]);
});

test('a code that is broken over lines is read, with the name before it', () => {
  for (const at of [5, 9, 12]) {
    const { rows, unread } = readLines(RECORD, `Ann ${CODE.slice(0, at)}\n${CODE.slice(at)}\nBen ${CODES[1]}`);
    assert.deepEqual(
      [unread, rows.map(({ line, name }) => [line, name])],
      [
        [],
        [
          [1, 'Ann'],
          [3, 'Ben'],
        ],
      ],
    );
  }
  const wrong = CODE.slice(0, -1) + (CODE.endsWith('B') ? 'C' : 'B');
  assert.deepEqual(readLines(RECORD, `Ann ${wrong.slice(0, 7)}\n${wrong.slice(7)}`).rows, []);
});

test('why a line is not read', () => {
  const why = (line) => readLines(RECORD, line).unread.map((each) => each.why + each.sign);
  assert.deepEqual(why('Ben BCDF-GHJK'), ['short']);
  assert.deepEqual(why('just words'), ['words']);
  assert.deepEqual(why(`${CODE} Ann\nAnn Schulze-Lange`), ['words', 'words']);
  assert.deepEqual(why(`Ben ${CODE.slice(0, -1)}E`), ['signE']);
  assert.deepEqual(why(`Ben ${CODE.slice(0, -1)}${CODE.endsWith('B') ? 'C' : 'B'}`), ['check']);
  assert.deepEqual(why(codeOf({ ...RECORD, lesson: 'two' }, given, 5)), ['other']);
  assert.deepEqual(why(`A ${CODE}\nB ${CODE}`), ['twice']);
  const { beyond, unread } = readLines(RECORD, 'x\n'.repeat(MOST + 2));
  assert.deepEqual([beyond, unread.length], [2, MOST]);
  assert.equal(readLines(RECORD, `${'x'.repeat(60_000)}\n`.repeat(3)).beyond, 2);
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
  const names0 = lines[0].replace('\ufeff', '').split(',');
  const cells = (line) => Object.fromEntries(lines[line].split(',').map((cell, k) => [names0[k], cell]));
  const wanted = [
    'name',
    'email',
    'id',
    'code',
    'points',
    'points.first',
    'points.most',
    'q',
    'q.text',
    'q.right',
    'back',
    'back.unit',
  ];
  assert.deepEqual(
    names0.slice(0, 12),
    wanted.map((name) => `"${name}"`),
  );
  for (const [line, name, q] of [
    [1, "'=SUM(A1)", ''],
    [2, "'+1", '2'],
  ]) {
    const found = cells(line);
    assert.deepEqual(
      ['name', 'code', 'q', 'back', 'back.unit', 'back.tries'].map((key) => found[`"${key}"`]),
      [name, CODE, q, '-58.2', 'µs', '2'].map((cell) => `"${cell}"`),
    );
  }
  assert.deepEqual(
    lines.slice(3, 8).map((line) => line.split(`,"","","${CODE}`)[0]),
    [`"'-1"`, `"'@x"`, '"a ""b"", c"', `"'\t=1"`, '"Ann"'],
  );
});

test('what is made to look like codes takes no longer than codes do', () => {
  const letters = (values) => values.map((value) => 'BCDFGHJKLMNPQRSTWXZ'[value]).join('');
  const [CHECK, SEAL, P] = [[2, 1, 1, 15], [3, 7, 11, 5], 19];
  const after = (rest, value) =>
    CHECK.map((each, k) => ((k ? rest[k - 1] : 0) + (P - ((value + rest[3]) % P)) * each) % P);
  const begun = [...codeOf(RECORD, given, 5).replaceAll('-', '').slice(0, 8)].map((each) =>
    'BCDFGHJKLMNPQRSTWXZ'.indexOf(each),
  );
  let rest = begun.reduce(after, [1, 2, 3, 4]);
  const pieces = [letters(begun)]; // each of those that follow checks all before it, and is a beginning itself
  for (let k = 0; k < 12_000; k += 1) {
    const seal = SEAL.map((each, n) => (P - rest[3 - n] + each) % P);
    rest = seal.reduce(after, rest);
    pieces.push(letters(seal));
  }
  for (const text of [
    pieces.join(' '),
    'C '.repeat(50_000),
    'C'.repeat(100_000),
    `${'CCCC'.repeat(40)} `.repeat(600),
  ]) {
    const before = process.cpuUsage();
    const { rows } = readLines(RECORD, text);
    const { user } = process.cpuUsage(before); // µs
    assert.ok(rows.length <= 1); // one of them may happen to be one
    assert.ok(user < 2e6, `${user} µs for ${text.slice(0, 20)}`);
  }
});

test('a course finds a student by address or number', () => {
  const whole = {
    'Doe, Jane, jane.doe@uni.example': ['Doe, Jane', 'jane.doe@uni.example', ''],
    'jane@uni.example': ['', 'jane@uni.example', ''],
    'Jane Doe <jane@uni.example> 1234567': ['Jane Doe', 'jane@uni.example', '1234567'],
    'Müller; 20231234; mueller@uni.example': ['Müller', 'mueller@uni.example', '20231234'],
    'UX20231 Ann': ['Ann', '', 'UX20231'],
    'Ann 12': ['Ann 12', '', ''],
    'Group 3, Ann @home': ['Group 3, Ann @home', '', ''],
    '+49 ': ['+49 ', '', ''],
  };
  for (const [written, wanted] of Object.entries(whole)) assert.deepEqual(whoOf(written), wanted, written);
  for (const who of Object.keys(whole)) {
    const { rows } = readLines(RECORD, `${who} ${CODE}`);
    const [, email, id] = whoOf(rows[0].name);
    assert.deepEqual([email, id], whole[who].slice(1), who);
  }
});
