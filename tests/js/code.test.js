// The impact as a scene file, a command and Python.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { commandsOf, partsOf, pythonOf } from '../../app/static/panels/code.js';

const HEAD = [
  'title = "A rod, { struck }"',
  '[method]',
  'name = "waves"',
  '[saved]',
  'methods = { waves = { name = "waves", steps = 9 }, modal = { name = "modal", modes = 50, residual = true } }',
].join('\n');

test('the scene stands alone, and methods beside its own follow', () => {
  const { scene, others } = partsOf(HEAD);
  assert.equal(scene, 'title = "A rod, { struck }"\n\n[method]\nname = "waves"\n');
  const modal = [
    ['name', '"modal"'],
    ['modes', '50'],
    ['residual', 'true'],
  ];
  assert.deepEqual(others, [modal]);
  assert.deepEqual(partsOf('title = "x"\n[saved]\n').others, []);
});

test('each method has a command and a line', () => {
  const { others } = partsOf(HEAD);
  assert.deepEqual(commandsOf('a.toml', others).split('\n'), [
    'impact solve a.toml',
    'impact solve a.toml --set method.name=modal --set method.modes=50 --set method.residual=true',
  ]);
  assert.deepEqual(pythonOf('a.toml', others).split('\n'), [
    'import solvers',
    '',
    'print(solvers.solve("a.toml"))',
    'print(solvers.solve("a.toml", "modal", modes=50, residual=True))',
  ]);
});
