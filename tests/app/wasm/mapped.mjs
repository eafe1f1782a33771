// Points of maps, by Node: of the server's answers in the files that are named on standard input, with the choices of
// each point. Figures alone, and beside them those of the whole answer.
import { readFileSync } from 'node:fs';
import { answersBy } from '../../../app/static/wasm/answers.js';
import { COLUMNS, figuresOfWhole } from '../../../app/static/wasm/columns.js';
import { figuresAt } from '../../../app/static/wasm/mapped.js';

globalThis.strikewaveTexts = { language: 'en', texts: {} }; // nothing is said here
const { decode } = await import('../../../app/static/wire/message.js');

const [, , module] = process.argv;
const answers = await answersBy(await WebAssembly.compile(readFileSync(module)));
const named = (row) => Object.fromEntries(COLUMNS.map((name, k) => [name, row[k]]));
const found = JSON.parse(readFileSync(0, 'utf8')).map(({ file, points }) => {
  const bytes = readFileSync(file);
  const frame = decode(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
  return points.map((point) => {
    const chosen = { ...frame.chosen, ...point };
    const alone = named(figuresAt(answers, frame, chosen));
    const changed = Object.keys(point).filter((name) => !Object.is(point[name], frame.chosen[name]));
    const whole = answers.covers(frame, changed) ? answers.answer(frame, chosen) : null;
    return { alone, whole: named(figuresOfWhole(whole)) };
  });
});
console.log(JSON.stringify(found));
process.exit(0); // it does not wait to give memory back
