// Answers of a module, by Node: to impacts on standard input, on standard output.
import { readFileSync } from 'node:fs';
import { answersOf } from './answers.mjs';

const given = JSON.parse(readFileSync(0, 'utf8'));
console.log(JSON.stringify(await answersOf(readFileSync(process.argv[2]), given)));
