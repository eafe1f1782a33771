// What choices and their values are called on the page.
import { naming } from './charts.js';

export const LABELS = {
  scene: ['Scene', '', {}],
  method: ['Method beside the exact one', '', {
    waves: 'Modes (pictures: exact)', modal: 'Modes', 'fe-nodal': 'Finite elements', 'fe-modal': 'Modes of finite elements', balance: 'Impulse balances',
    'mode-switch': 'Modes that switch', 'quasi-static': 'Quasi-static', rigid: 'Rigid bodies', 'floating-frame': 'Floating frame',
  }],
  mass_ratio: ['Mass ratio', 'm₂/m₁', null, 'log'],
  speed: ['Impact speed', 'm/s', null, 'log'],
  law: ['Contact law', '', {
    rigid: 'Rigid', linear: 'Linear spring', hertz: 'Hertz', power: 'Power law', 'kelvin-voigt': 'Kelvin–Voigt', 'lee-wang': 'Lee–Wang', 'hunt-crossley': 'Hunt–Crossley',
    'lankarani-nikravesh': 'Lankarani–Nikravesh', 'yigit-christoforou': 'Yigit–Christoforou', 'plastic-linear': 'Plastic, linear', 'plastic-power': 'Plastic, power (Tabor)',
  }],
  linear_stiffness: ['Stiffness', 'N/m', null, 'log'],
  hertz_stiffness: ['Stiffness', 'N/m¹·⁵', null, 'log'],
  force_at_depth: ['Force at 10 µm', 'N', null, 'log'],
  exponent: ['Exponent', '', null],
  yield_indentation: ['Yields at', 'm', null, 'log'],
  restitution: ['Restitution', '', null],
  modes: ['Modes', 'kept', null, 'log'],
  elements: ['Elements', '', null, 'log'],
  place: ['Struck at', 'of its length', null],
  support: ['Support', '', { cantilever: 'Cantilever', 'pinned-pinned': 'Pinned at both ends', 'clamped-clamped': 'Clamped at both ends', 'free-free': 'Free at both ends', 'pinned-free': 'Pinned and free' }],
  theory: ['Theory', '', { 'euler-bernoulli': 'Euler–Bernoulli', timoshenko: 'Timoshenko' }],
  slenderness: ['Length over depth', '', null, 'log'],
  damping: ['Modal damping', 'of critical', null],
};

// A sentence of the library in the words of the page: what scene files call `theory = 'timoshenko'` or 'modal'.
export function plainly(sentence) {
  return sentence
    .replace(/\b(?:use )?([a-z_]+) = '([\w-]+)'/g, (said, name, value) => (LABELS[name]?.[2]?.[value] ? `choose ${LABELS[name][0]}: ${LABELS[name][2][value]}` : said))
    .replace(/\b([a-z_]+) = (-?[\d.]+(?:e[+-]?\d+)?)(?=[\s,;:]|\.?$)/g, (said, name, value) => (LABELS[name] ? `${LABELS[name][0]}: ${value}` : said))
    .replace(/'([\w-]+)'/g, (said, name) => (name in LABELS.method[2] ? naming(name) : LABELS.law[2][name] ?? said));
}
