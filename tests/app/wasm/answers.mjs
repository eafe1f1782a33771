// Answers of the module for impacts that are read from standard input, on standard output.
import { readFileSync } from 'node:fs';
const [, , module, kernels] = process.argv;
const { kernelsOf } = await import(kernels);
const found = await kernelsOf(readFileSync(module));
const answers = JSON.parse(readFileSync(0, 'utf8')).map(([beta, reflection]) => {
  const impact = found.rod(beta, reflection);
  if (!impact) return {};
  const { contacts, duration, histories, impulse, target, compressing, energy } = impact;
  const { waveTime, wave, forceTime, force, mass, end, whole } = histories;
  const out = [impulse, target, compressing, energy, contacts.length, duration, waveTime.length, forceTime.length];
  const listed = contacts.flatMap((c) => [c.start, c.end, c.before, c.after, c.peak, c.face]);
  const drawn = { wave_time: waveTime, wave, force_time: forceTime, force, mass, end, whole };
  const flat = Object.entries(drawn).map(([name, values]) => [name, [...values]]);
  return { ...Object.fromEntries(flat), out, contacts: listed };
});
console.log(JSON.stringify(answers));
