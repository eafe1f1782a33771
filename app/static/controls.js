// The form: one control for each choice, made from the bounds that the server holds.
import { LABELS, plainly } from './words.js';

const ORDER = ['scene', 'mass_ratio', 'speed', 'place', 'support', 'theory', 'slenderness', 'damping', 'law', 'linear_stiffness', 'hertz_stiffness', 'force_at_depth', 'exponent', 'yield_indentation', 'restitution', 'modes', 'elements', 'method'];
const STEPS = 1000;

const make = (tag, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
};

export class Controls {
  // `send(name, value)` takes every change that the visitor makes; `complain` what is no number at all.
  constructor(spec, send, complain) {
    this.spec = spec;
    this.send = send;
    this.complain = complain;
    this.root = make('form', { className: 'controls' });
    this.root.onsubmit = (event) => event.preventDefault();
    this.fields = {};
    for (const name of ORDER) this.root.append(spec[name].options ? this.select(name) : this.slider(name));
    this.note = make('p', { className: 'help' });
    this.fields.restitution.root.append(this.note);
  }
  select(name) {
    const [label, , words] = LABELS[name], id = `choice-${name}`;
    const input = make('select', { id });
    const groups = this.spec[name].groups ?? [['', this.spec[name].options.map((option) => [option, words[option] ?? option])]];
    for (const [heading, options] of groups) {
      const made = options.map(([value, text]) => make('option', { value, textContent: text }));
      input.append(...(heading ? [make('optgroup', { label: heading }, ...made)] : made));
    }
    input.onchange = () => this.send(name, input.value);
    const root = make('div', { className: `field field-${name}` }, make('label', { htmlFor: id, textContent: label }), input);
    this.fields[name] = { root, input, set: (value) => { input.value = value; input.title = input.selectedOptions[0]?.textContent ?? ''; } };
    return root;
  }
  slider(name) {
    const [label, unit, , scale] = LABELS[name], { low, high, whole } = this.spec[name], id = `choice-${name}`;
    const log = scale === 'log';
    const range = make('input', { type: 'range', id, min: 0, max: STEPS, step: 1 });
    const number = make('input', { type: 'text', inputMode: 'decimal', className: 'number', autocomplete: 'off', maxLength: 24 });
    number.setAttribute('aria-label', `${label}, exact value`);
    const toValue = (place) => {
      const value = log ? low * (high / low) ** (place / STEPS) : low + (high - low) * place / STEPS;
      return whole ? Math.round(value) : Number(value.toPrecision(log ? 3 : 12));
    };
    const toPlace = (value) => Math.round(STEPS * (log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low)));
    const show = (value) => {
      number.value = whole ? String(value) : pretty(value);
      range.setAttribute('aria-valuetext', `${number.value} ${unit}`);
      range.style.setProperty('--fill', `${toPlace(value) / STEPS * 100}%`);
    };
    let held = false;
    range.oninput = () => { held = true; const value = toValue(Number(range.value)); show(value); this.send(name, value); };
    range.onchange = () => { held = false; };
    range.onkeydown = (event) => { // whole numbers move by whole numbers, also where the scale is logarithmic
      const way = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
      if (!whole || !way) return;
      event.preventDefault();
      const value = Math.min(Math.max(Number(number.value) + way, low), high);
      range.value = toPlace(value); show(value); this.send(name, value);
    };
    let last;
    number.onchange = () => {
      const text = number.value.trim().replace(',', '.'), plain = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(text);
      if (plain && (!whole || Number.isInteger(Number(text)))) { this.send(name, Number(text)); return; }
      this.complain(`${name}: got '${text.slice(0, 24)}'; allowed: a ${whole ? 'whole ' : ''}number from ${low} to ${high}`);
      show(last);
    };
    const head = make('div', { className: 'field-head' }, make('label', { htmlFor: id, textContent: label }), number, make('span', { className: 'unit', textContent: unit }));
    const root = make('div', { className: `field field-${name}` }, head, range);
    this.fields[name] = { root, set: (value, refused) => { last = value; if (refused) held = false; if (held) return; range.value = toPlace(value); show(value); } };
    return root;
  }
  // `refused`: back to this value, also where the hand still holds the slider.
  show(name, value, refused = false) { this.fields[name]?.set(value, refused); }
  // Only what acts on this scene is shown; methods that cannot solve it say why.
  arrange(frame) {
    const { restitution, method } = frame.chosen;
    for (const name of ORDER) this.fields[name].root.hidden = !frame.acting.includes(name);
    const onBeam = frame.kind === 'beam';
    this.fields.method.root.firstChild.textContent = onBeam ? 'Method' : LABELS.method[0];
    for (const option of this.fields.method.input.options) {
      if (option.value === 'waves') option.textContent = onBeam ? 'Travelling waves' : LABELS.method[2].waves;
      const reason = frame.refusals[option.value];
      option.disabled = Boolean(reason) && (onBeam || option.value !== 'waves');
      option.title = plainly(reason ?? '');
    }
    if (frame.kind === 'bodies') { this.note.textContent = 'Speed of parting over speed of approach of the touching points, along the normal.'; return; }
    if (onBeam) { this.note.textContent = frame.law.damps ? 'Sets what this contact delivers between two rigid bodies.' : 'Sets the restitution of every balance.'; return; }
    const match = frame.match === null ? '' : ` To match the last velocity: ${frame.match.toFixed(3)}.`, least = frame.leastRestitution;
    const acts = frame.damps ? `Sets what this contact delivers between two rigid bodies, and the ghost.${restitution < least ? ` The law delivers no less than ${least}; it uses that.` : ''} The usual formula of this law would call it ${frame.nominal.toFixed(2)}.`
      : method === 'balance' ? 'Sets the restitution of every balance, and the ghost.'
      : `Sets the ghost: the answer of rigid-body theory, dashed grey. ${frame.yields ? 'This contact loses by yielding.' : 'This contact law itself loses nothing.'}`;
    const refused = frame.refusals[method];
    this.note.textContent = acts + match + (refused && method !== 'waves' ? ` ${plainly(refused)}` : '');
  }
}

export function pretty(value) {
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) return value.toExponential(2).replace(/\.?0+e/, 'e').replace('e+', 'e');
  return String(Number(value.toPrecision(4)));
}
