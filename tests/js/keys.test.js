// Which undo a key means: that of the field that is written in, or that of the page.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Writing } from '../../app/static/frame/keys.js';

/** A field below the page, as far as events go. */
class Field extends EventTarget {
  tagName = 'INPUT';
  ariaInvalid = 'false';
  value = '1';
  getAttribute = () => 'text';
  /** @param {EventTarget} root */
  constructor(root) {
    super();
    this.root = root;
  }
  /**
   * @param {string} type
   * @param {object} [more]
   */
  send(type, more = {}) {
    const event = Object.assign(new Event(type), more, { composedPath: () => [this] });
    this.dispatchEvent(event);
    const above = Object.assign(new Event(type), more, { composedPath: () => [this] });
    this.root.dispatchEvent(above);
  }
  /** @param {string} value */
  write(value, inputType = 'insertText') {
    this.send('beforeinput', { inputType });
    this.value = value;
    this.send('input', { inputType });
  }
}

/** A page with a field, and whether a key is the field's. */
function page() {
  const root = new EventTarget();
  const writing = new Writing(root);
  const field = new Field(root);
  const takes = () => writing.takes(/** @type {any} */ ({ key: 'z', composedPath: () => [field] }));
  return { field, takes };
}

test('what is being written is undone by the field, what was chosen by the page', () => {
  const { field, takes } = page();
  assert.ok(!takes());
  field.write('3');
  assert.ok(takes());
  field.send('change'); // Enter
  assert.ok(!takes());
  field.write('35');
  field.write('3');
  assert.ok(!takes()); // nothing is left to be taken back
});

test('what is refused stands in its field, whose undo takes it back', () => {
  const { field, takes } = page();
  field.write('2 kg');
  field.ariaInvalid = 'true';
  field.send('change');
  assert.ok(takes());
});

test('an undo from the menu of the browser is chosen at once', () => {
  const { field } = page();
  let chosen = 0;
  field.addEventListener('change', () => (chosen += 1));
  field.write('3');
  field.send('change');
  field.write('1', 'historyUndo');
  assert.equal(chosen, 2);
});
