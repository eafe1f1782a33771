// Answers of a module, by Node: to impacts on standard input, on standard output; or, with a share, how they are left.
import { readFileSync } from 'node:fs';
import { answersOf, leftOf } from './answers.mjs';

const given = JSON.parse(readFileSync(0, 'utf8'));
const [, , module, share] = process.argv;
const bytes = readFileSync(module);
console.log(JSON.stringify(await (share ? leftOf(bytes, given, Number(share)) : answersOf(bytes, given))));
