// Answers of a module, by Node, with so much work for each: to impacts on standard input, on standard output.
import { readFileSync } from 'node:fs';
import { answersOf } from './answers.mjs';

const given = JSON.parse(readFileSync(0, 'utf8'));
const [, , module, work] = process.argv;
console.log(JSON.stringify(await answersOf(readFileSync(module), given, Number(work))));
