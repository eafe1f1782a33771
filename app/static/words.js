// What choices and their values are called on the page.
import { naming } from './charts.js';
import { raised } from './logplot.js';

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

// What a scene says of itself, and where keys are set that have no control here.
export function noteOf({ note }) {
  const keys = /\b(method|target|impactor|contact)\.[a-z_]+|\b(model|variant|status|smoothing|frame|steps|contact_stiffness) ?= ?[\w-]/.test(note ?? '');
  return keys ? `${note} (Keys without a control here: in a scene file, or impact solve --set KEY=VALUE.)` : note;
}

// A sentence of the library in the words of the page: what scene files call `theory = 'timoshenko'` or 'modal'.
export function plainly(sentence) {
  return powered(sentence
    .replace(/\b(?:use )?([a-z_]+) = '([\w-]+)'/g, (said, name, value) => (LABELS[name]?.[2]?.[value] ? `choose ${LABELS[name][0]}: ${LABELS[name][2][value]}` : said))
    .replace(/\b([a-z_]+) = (-?[\d.]+(?:e[+-]?\d+)?)(?=[\s,;:]|\.?$)/g, (said, name, value) => (LABELS[name] ? `${LABELS[name][0]}: ${value}` : said))
    .replace(/status 'implicit'/g, 'the implicit contact status (from the command line: --set method.status=implicit)')
    .replace(/'([\w-]+)((?: \w+=[\w.+-]+)*)'/g, (said, name, options) => (name in LABELS.method[2] ? described(name + options) : LABELS.law[2][name] ?? said))
    .replace(/(?<![\w-])([a-z-]+)((?: \w+=[\w+-]+(?:\.\w+)*)+)/g, (said, name, options) => (name in LABELS.method[2] ? described(name + options) : said))
    .replace(/sqrt\((\w+)\)/g, '√$1')
    .replace(/sqrt\(([^()]+)\)/g, '√($1)')
    .replace(/\bomega_(\w+)/g, 'ω_$1')
    .replace(/\brho\b/g, 'ρ')
    .replace(/(\d[\d.]*(?:e[+-]\d+)?) s\b/g, (said, value) => (value > 0 && (said.includes('e') || value < 0.1) ? shortTime(Number(value)) : said)));
}
// Numbers such as 1.9e+10 as powers of ten.
const powered = (text) => text.replace(/(\d[\d.]*)e([+-]\d+)/g, (said, digits, power) => `${digits === '1' ? '' : `${digits}·`}10${raised(Number(power))}`);

// A time below a second [s] with the unit that suits it.
function shortTime(value) {
  const [times, unit] = value < 1e-6 ? [1e9, 'ns'] : value < 1e-3 ? [1e6, 'µs'] : value < 1 ? [1e3, 'ms'] : [1, 's'];
  return `${Number((times * value).toPrecision(3))} ${unit}`;
}

const COUNTS = ['modes', 'elements', 'steps'];
const COUNTED = { modal: ['modes', 'modes'], 'mode-switch': ['modes', 'switched modes'], 'fe-nodal': ['elements', 'finite elements'] };

// A method with its resolution, "fe-nodal elements=12 scheme=central-difference", in the words of the page.
export function described(label) {
  const [name, ...given] = label.split(' '), options = given.map((option) => option.split('='));
  const [knob, word] = COUNTED[name] ?? [], count = options.find(([key]) => key === knob);
  const said = ([key, value]) => (!/^\d/.test(value) ? value.replaceAll('-', ' ') : COUNTS.includes(key) ? `${value} ${key}` : `${key.replaceAll('_', ' ')} ${powered(value.replace(/\.0$/, ''))}`);
  const rest = options.filter((option) => option !== count).map(said);
  return [count ? `${count[1]} ${word}` : naming(name), ...rest].join(', ');
}
