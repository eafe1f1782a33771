// What the panels beside the solution share: a button, a section, and whether an answer is that to the choices drawn.
export const make = (tag, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
};
export const QUANTITIES = { rebound: 'final velocity', impulse: 'impulse', 'peak-force': 'peak force', 'force-history': 'force over time', 'contact-time': 'first touch to last parting' };
const OF_THE_METHOD = ['method', 'modes', 'elements'];

export class Panel {
  // `name`: of the properties of the model; `asked`: those that are asked besides the choices.
  constructor(page, name, label, title, heading, asked = []) {
    Object.assign(this, { page, name, asked });
    this.button = make('button', { type: 'button', textContent: label, title, onclick: () => this.toggle() });
    this.root = make('section', { className: `analysis ${name}`, hidden: true }, make('h2', { textContent: heading }));
    for (const each of [name, ...asked]) page.model.on(each, () => this.fill());
  }
  get open() { return this.page.model[`${this.name}_shown`]; }
  toggle() {
    this.page.model[`${this.name}_shown`] = !this.open;
    this.take();
    this.opened?.();
    if (this.open) this.root.scrollIntoView({ behavior: 'smooth', block: 'nearest' });
  }
  take() {
    this.button.setAttribute('aria-pressed', String(this.open));
    this.root.hidden = !this.open;
    this.fill();
  }
  get answer() {
    const text = this.page.model[this.name];
    if (text !== this.text) { this.text = text; this.read = text ? JSON.parse(text) : null; }
    return this.read;
  }
  // Whether an answer is that to the scene drawn, by whatever method, and to what is asked.
  fresh(found) {
    const { page } = this;
    return Boolean(found) && page.names.every((key) => OF_THE_METHOD.includes(key) || found.chosen[key] === page.frame.chosen[key]) && this.asked.every((key) => found.chosen[key] === page.model[key]);
  }
  fill() {
    if (!this.root.hidden && this.page.frame) this.told(this.answer, this.fresh(this.answer));
  }
  show() {}
  draw() {}
}

// Show a method and its resolution on the page, as far as its sliders reach.
export function showMethod(page, method) {
  const { spec } = page.model, choices = { method: method.name }, left = [];
  if (!spec.method.options.includes(method.name)) { page.complain(`The page cannot show '${method.name}'.`); return; }
  if (page.frame.refusals?.[method.name] && method.name !== 'waves') { page.complain(page.frame.refusals[method.name]); return; }
  for (const name of ['modes', 'elements']) {
    if (!Number.isFinite(method[name])) continue;
    choices[name] = Math.min(Math.max(method[name], spec[name].low), spec[name].high);
    if (choices[name] !== method[name]) left.push(`${choices[name]} ${name}, as many as its slider has, instead of ${method[name]}`);
  }
  for (const [name, value] of Object.entries(choices)) if (name !== 'method') page.waiting[name] = value;
  page.send('method', choices.method);
  if (left.length) page.complain(`Shown with ${left.join(' and ')}.`);
}
// Whether the page shows it.
export const shown = (page, method) => page.frame.chosen.method === method.name && ['modes', 'elements'].every((name) => !Number.isFinite(method[name]) || page.frame.chosen[name] === method[name]);
