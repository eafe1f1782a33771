// The impact that is shown, to take along: its scene file, and the command and the Python lines that solve it again.
import { make } from '../browser/dom.js';
import { partOf } from '../frame/code_part.js';
import { fileOf } from '../wire/own.js';
import { text } from '../text/catalogue.js';
import { Panel } from './panel.js';

/** @import { Page } from '../page.js' */

const LIBRARY = 'solvers';
const SOLVE = ['impact', 'solve'];
const TABLE = '\n[saved]'; // at the end of a head: what is no part of the scene
const METHODS = /([\w-]+) = \{ ([^{}]*) \}/g; // of several columns, by their names
const PAIR = /([\w-]+) = ("[^"]*"|[^,]*)/g;

/** @typedef {[option: string, value: string][]} Options  as TOML writes them */

/**
 * The scene file in the head of saved histories, and the methods besides its own.
 * @param {string} head
 * @returns {{ scene: string, others: Options[] }}
 */
export function partsOf(head) {
  const [scene, saved = ''] = head.split(TABLE);
  const found = [...saved.matchAll(METHODS)].map(([, , options]) =>
    [...options.matchAll(PAIR)].map(([, option, value]) => /** @type {[string, string]} */ ([option, value])),
  );
  const spaced = scene.trim().replaceAll('\n[', '\n\n[');
  return { scene: `${spaced}\n`, others: found.slice(1) }; // the first is that of the scene
}

/** @param {string} value  as TOML writes it */
const inPython = (value) => (/^(true|false)$/.test(value) ? value[0].toUpperCase() + value.slice(1) : value);

/**
 * @param {string} file
 * @param {Options[]} others
 */
export function commandsOf(file, others) {
  const bare = (/** @type {string} */ value) => value.replaceAll('"', '');
  const set = (/** @type {Options} */ options) =>
    options.flatMap(([option, value]) => ['--set', `method.${option}=${bare(value)}`]);
  return [[], ...others].map((options) => [...SOLVE, file, ...set(options)].join(' ')).join('\n');
}

/**
 * @param {string} file
 * @param {Options[]} others
 */
export function pythonOf(file, others) {
  const solved = [[], ...others].map((given) => {
    const options = Object.fromEntries(given);
    const { name, ...rest } = options;
    const words = Object.entries(rest).map(([option, value]) => `${option}=${inPython(value)}`);
    return `print(${LIBRARY}.solve(${[`"${file}"`, ...(name ? [name] : []), ...words].join(', ')}))`;
  });
  return [['import', LIBRARY].join(' '), '', ...solved].join('\n');
}

class Code extends Panel {
  static beside = true; // has room in the dock; the charts stay

  /** @param {Page} page */
  constructor(page) {
    super(page, 'code', text('code.button'), text('code.about'), text('code.heading'));
    this.said = make('p', { className: 'help', role: 'status' });
    this.parts = /** @type {const} */ (['command', 'python', 'scene']).map((name) =>
      partOf(name, this.said, () => this.file),
    );
    this.root.append(this.said, ...this.parts.map(({ root }) => root));
  }
  get file() {
    return `${fileOf(this.page.frame.chosen.scene)}.toml`;
  }
  fill() {
    const { frame, own } = this.page;
    if (this.root.hidden || !frame) return;
    const awaited = own.made.has(frame); // its head says what the server has solved
    this.root.ariaBusy = String(awaited);
    for (const { root } of this.parts) root.hidden = awaited;
    if (awaited) {
      this.said.textContent = text('page.not-yet');
      return;
    }
    const { scene, others } = partsOf(frame.head);
    const { file } = this;
    const written = { scene, command: commandsOf(file, others), python: pythonOf(file, others) };
    for (const { name, code } of this.parts) if (code.textContent !== written[name]) code.textContent = written[name];
    this.said.textContent = text('code.help', { file });
  }
}

export const PANELS = { code: Code }; // by their names in the address
