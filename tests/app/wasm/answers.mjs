// What the module, of these bytes, answers to impacts: the same for every engine.
import { balanceImpact } from '../../../app/static/wasm/balance.js';
import { chainImpact } from '../../../app/static/wasm/chain_kernel.js';
import { kernelsOf } from '../../../app/static/wasm/kernels.js';
import { ofFrame } from '../../../app/static/wasm/modal.js';

const drawn = ({ waveTime, wave, forceTime, force, mass, end, whole }) => ({
  ...{ wave_time: [...waveTime], wave: [...wave], force_time: [...forceTime], force: [...force] },
  ...{ mass: [...mass], end: [...end], whole: [...whole] },
});

function rod(found, [beta, reflection]) {
  const impact = found.rod(beta, reflection);
  if (!impact) return {};
  const { apart, contacts, duration, energy, final, histories, impulse, target, compressing } = impact;
  const out = [impulse, target, compressing, energy, final, apart, duration];
  return { ...drawn(histories), out, contacts: contacts.flatMap((c) => [c.start, c.end, c.push, c.after, c.peak]) };
}

function law(found, [beta, reflection, name, constants, whole, asked]) {
  const impact = found.law(beta, reflection, { name, constants }, asked);
  if (!impact) return {};
  const { apart, compressing, contacts, cycle, dissipated, energy, final, histories, impulse, target } = impact;
  const { deepest, dent, depths, presses, loading, unloading } = cycle;
  const out = [impulse, final, target, apart, compressing, energy, dissipated, deepest, dent];
  const listed = { out, contacts: contacts.flatMap((c) => [c.start, c.end, c.push, c.peak, c.after]) };
  if (!whole) return listed;
  const path = { depths: [...depths], presses: [...presses], loading: [...loading], unloading: [...unloading] };
  return { ...listed, ...drawn(histories), ...path };
}

function modes(found, [beta, reflection, name, constants, count, touching, duration, kind]) {
  const of = kind === 'given' ? ofFrame(count) : undefined;
  const impact = found.modes(beta, reflection, { name, constants }, count, touching, duration, kind, of);
  if (!impact) return {};
  const { contacts, force, mass, end, ...figures } = impact;
  const rows = contacts.map((c) => [c.start, c.end, c.push, c.peak, c.after]);
  return { ...figures, contacts: rows, force: [...force], mass: [...mass], end: [...end] };
}

function struckBy({ rigidMass, whole, ...rest }) {
  const infinite = (value) => value ?? Infinity;
  return { ...rest, rigidMass: infinite(rigidMass), whole: infinite(whole) };
}

const beamFigures = (found, [struck, name, constants]) =>
  found.beamFigures(struckBy(struck), { name, constants }) ?? {};

function beam(found, [struck, name, constants]) {
  const impact = found.beam(struckBy(struck), { name, constants });
  if (!impact) return {};
  const { contacts, cycle, force, rates, time, impactor, struck: face, impactorRate, struckRate, ...figures } = impact;
  const rows = contacts.map((c) => [c.start, c.end, c.push, c.peak, c.after]);
  const all = { time, impactor, face, impactorRate, struckRate, rates, force, depths: cycle.depths };
  const lists = Object.fromEntries(Object.entries(all).map(([each, values]) => [each, [...values]]));
  return { ...figures, ...lists, contacts: rows };
}

function spring(found, [mass, carried, stiffness, duration]) {
  const impact = found.spring(mass, carried, stiffness, duration);
  if (!impact) return {};
  const lists = Object.entries(impact).map(([each, value]) => [each, value.length ? [...value] : value]);
  return Object.fromEntries(lists);
}

function compact(found, [mass, whole, pressed, sine]) {
  const impact = found.compact(mass, whole ?? Infinity, pressed, sine);
  if (!impact) return {};
  const lists = Object.entries(impact).map(([each, value]) => [each, value.length ? [...value] : value]);
  const { cycle } = impact;
  const path = Object.fromEntries(Object.entries(cycle).map(([each, v]) => [each, v.length ? [...v] : v]));
  return { ...Object.fromEntries(lists), cycle: path };
}

function chain(found, [rods, kinds, gaps, asked, mass, end]) {
  const impact = chainImpact(found, rods, { kinds, gaps, asked }, mass, end);
  if (!impact) return {};
  const { waves, ...rest } = impact;
  const lists = Object.entries(rest).map(([each, value]) => [each, value.length ? [...value] : value]);
  return { ...Object.fromEntries(lists), waves: waves.map((wave) => wave.map((values) => [...values])) };
}

function balance(found, [made, duration]) {
  const impact = balanceImpact(found, made, duration);
  if (!impact) return {};
  const lists = Object.entries(impact).map(([each, value]) => [each, value?.length ? [...value] : value]);
  return Object.fromEntries(lists);
}

const figures = (found, [beta, reflection, name, constants, , asked, tolerance]) =>
  found.figures(beta, reflection, { name, constants }, asked, tolerance) ?? {};

const KINDS = { figures, beamFigures, rod, law, modes, beam, spring, compact, chain, balance };

const ofKind = (given, one) =>
  Object.fromEntries(Object.entries(given).map(([name, impacts]) => [name, impacts.map((each) => one(name, each))]));

export async function answersOf(bytes, given) {
  const found = await kernelsOf(bytes);
  return ofKind(given, (name, impact) => KINDS[name](found, impact));
}

// By a clock that goes on by one at each look: each impact answered, left at this share of the looks that it takes, and
// answered again.
export async function leftOf(bytes, given, share) {
  const found = await kernelsOf(bytes);
  let looks = 0;
  globalThis.performance.now = () => looks++;
  const within = (longest, ask) => {
    looks = 0;
    const [answer, late] = found.within(longest, ask);
    return { answer, late, looks };
  };
  return ofKind(given, (name, impact) => {
    const ask = () => KINDS[name](found, impact);
    const whole = within(Infinity, ask);
    const { late, looks: until } = within(Math.floor(share * (whole.looks - 2)), ask);
    return { ...whole, late, until, again: within(Infinity, ask).answer };
  });
}
