// Pack the page: its modules and sheets in a few files, without what only people read, by esbuild, into app/packed.
// The server sends these in place of the modules, as long as they are of these sources: app/page/packed.py.
import { createHash } from 'node:crypto';
import { mkdir, readdir, readFile, rm, writeFile } from 'node:fs/promises';
import { dirname, join, relative, sep } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const HERE = dirname(fileURLToPath(import.meta.url));
const [STATIC, PACKED] = ['app/static', 'app/packed'].map((folder) => join(HERE, folder));
const PAGE = 'page.js';
const SHEETS = 'sheets.css';
// of the page, and of what is fetched when it is wanted: what is there before
const BEFORE = {
  [PAGE]: [],
  'gallery/gallery.js': [PAGE],
  'courses/courses.js': [PAGE],
  'lesson/lesson.js': [PAGE],
  'classes/classes.js': [PAGE, 'lesson/lesson.js'],
  'sharing/class_link.js': [PAGE],
  'take/files.js': [PAGE],
  'wasm/answers.js': [PAGE],
  'whatif/entry.js': [PAGE, 'wasm/answers.js'],
};
// a folder without a server: scripts that are no modules, as browsers allow none to pages from the disk
const OFFLINE = {
  'offline/scenes.js': ['gallery/gallery.js', 'take/files.js', 'whatif/entry.js'],
  'offline/lessons.js': [
    'gallery/gallery.js',
    'take/files.js',
    'whatif/entry.js',
    'lesson/lesson.js',
    'courses/courses.js',
  ],
};
const WITHOUT = /^(mechanism|space|away)\//; // kinds of scene that no kernel answers there, and what minds the server
const ANALYSES = ['plan', 'record', 'stability', 'tolerance', 'tradeoff', 'trust']; // which a server makes
const UNUSED = ['space/stage.css', ...ANALYSES.map((name) => `panels/${name}.css`)];
const SCRIPTS = ['browser/modules.js', 'browser/start.js', 'offline/start.js']; // which are no modules
const WIDGET = 'offline/widget.js';
const WORKER = 'wasm/worker.js'; // whole by itself, as nothing of the page is there; without a server it is no module
const FIRST = './first.js'; // stands for what an entry does before all else
const SERVED = 'served:'; // before an address that a browser asks for

const COMMON = { absWorkingDir: STATIC, outdir: STATIC, outbase: STATIC, write: false, metafile: true };
const WHOLE = { ...COMMON, bundle: true, minify: true, charset: 'utf8', format: 'esm', target: 'es2023' };

const plain = (path) => path.split(sep).join('/');
const sources = (await readdir(STATIC, { recursive: true })).map(plain).sort();
const [modules, sheets] = ['.js', '.css'].map((ending) => sources.filter((name) => name.endsWith(ending)));

/** Of all sources, as app/page/packed.py makes it of those that are there. */
async function keyOf() {
  const hash = createHash('sha256');
  for (const name of sources.filter((each) => /\.(js|css)$/.test(each)))
    hash.update(`${name}\0`).update(await readFile(join(STATIC, name)));
  return hash.digest('hex');
}

/** An entry of this text, with other texts that stand for files. */
const entryOf = (contents, standIn = () => undefined) => ({
  stdin: { contents, resolveDir: STATIC, sourcefile: 'entry' },
  plugins: [
    {
      name: 'stand-in',
      setup({ onLoad, onResolve }) {
        onResolve({ filter: /^served:/ }, ({ path }) => ({ path: path.slice(SERVED.length), external: true }));
        onResolve({ filter: /^\./ }, ({ path, resolveDir }) => {
          const name = plain(relative(STATIC, join(resolveDir, path)));
          return standIn(name) === undefined ? undefined : { path: name, namespace: 'stand-in' };
        });
        onLoad({ filter: /./, namespace: 'stand-in' }, ({ path }) => {
          return { contents: standIn(path), resolveDir: STATIC, loader: path.endsWith('.css') ? 'css' : 'js' };
        });
      },
    },
  ],
});

/** A script, and which modules are in it. */
const made = (name, { metafile, outputFiles }) => {
  return {
    name,
    text: outputFiles[0].text,
    inputs: Object.keys(metafile.inputs).filter((each) => modules.includes(each)),
  };
};

/** What makes these modules known by their names. */
const known = (names) =>
  names.map((name, k) => `import * as m${k} from './${name}';\n`).join('') +
  `globalThis.strikewaveModules = { ${names.map((name, k) => `'${name}': m${k}`).join(', ')} };\n`;

/** By module, the names that it exports. */
async function exportsOf() {
  const { metafile } = await build({ ...COMMON, entryPoints: modules });
  return new Map(Object.values(metafile.outputs).map((each) => [each.entryPoint, each.exports]));
}

/** By entry, the modules that are in it, and what each imports. */
async function graphOf(panels) {
  const found = Object.keys(BEFORE).map(async (entry) => {
    const entryPoints = entry === PAGE ? [...panels, entry] : [entry];
    const { inputs } = (await build({ ...WHOLE, entryPoints })).metafile;
    return [entry, new Map(Object.entries(inputs).map(([name, { imports }]) => [name, imports.map((to) => to.path)]))];
  });
  return new Map(await Promise.all(found));
}

/** The page and its late modules: what is there before an entry exports to it what it needs, beside its own. */
async function pageOf(exported) {
  const texts = await Promise.all(modules.map(async (name) => [name, await readFile(join(STATIC, name), 'utf8')]));
  const panels = texts.flatMap(([name, text]) => (/^export const PANELS = /m.test(text) ? [name] : []));
  const graph = await graphOf(panels);
  const ownerOf = (entry, name) => BEFORE[entry].find((owner) => graph.get(owner).has(name));
  const shared = new Map(Object.keys(BEFORE).map((entry) => [entry, new Set()]));
  for (const [entry, all] of graph)
    for (const [name, imports] of all)
      for (const each of ownerOf(entry, name) ? [] : imports) shared.get(ownerOf(entry, each))?.add(each);
  const nameOf = (name, each) => `x${modules.indexOf(name)}_${each}`;
  const packed = Object.keys(BEFORE).map(async (entry) => {
    const given = [...shared.get(entry)].map(
      (name) => `export { ${exported.get(name).map((each) => `${each} as ${nameOf(name, each)}`)} } from './${name}';`,
    );
    const contents = [`import '${FIRST}';`, `export * from './${entry}';`, ...given].join('\n');
    const standIn = (name) => {
      if (FIRST.endsWith(`/${name}`)) return entry === PAGE ? known(panels) : '';
      const owner = ownerOf(entry, name);
      const names = exported.get(name)?.map((each) => `${nameOf(name, each)} as ${each}`);
      return owner && `export { ${names} } from '${SERVED}${'../'.repeat(entry.split('/').length - 1)}${owner}';`;
    };
    return made(entry, await build({ ...WHOLE, ...entryOf(contents, standIn) }));
  });
  return Promise.all(packed);
}

/** The scripts of a folder: each defines a function that runs the page. */
async function offlineOf(exported) {
  const packed = Object.entries(OFFLINE).map(async ([name, late]) => {
    const standIn = (each) => {
      if (FIRST.endsWith(`/${each}`)) return known(late);
      if (!WITHOUT.test(each)) return undefined;
      return exported
        .get(each)
        ?.map((absent) => `export const ${absent} = undefined;\n`)
        .join('');
    };
    const done = await build({
      ...{ ...WHOLE, ...entryOf(`import '${FIRST}';\nimport './offline/page.js';`, standIn) },
      define: { 'import.meta.url': 'document.baseURI' },
      banner: { js: 'globalThis.strikewavePage = async () => {\n"use strict";' },
      footer: { js: '};' },
    });
    return made(name, done);
  });
  return Promise.all(packed);
}

/** All sheets that are fetched, and that of a folder. */
async function sheetsOf() {
  const { metafile, outputFiles } = await build({ ...WHOLE, entryPoints: [SHEETS] });
  const unknown = UNUSED.filter((name) => !(name in metafile.inputs));
  if (unknown.length) throw new Error(`not in ${SHEETS}: ${unknown}`);
  const apart = sheets.filter((name) => !(name in metafile.inputs));
  const others = await build({ ...WHOLE, entryPoints: apart });
  const standIn = (name) => (UNUSED.includes(name) ? '' : undefined);
  const entry = entryOf(`@import './${SHEETS}';`, standIn);
  const offline = await build({ ...WHOLE, ...entry, stdin: { ...entry.stdin, loader: 'css' } });
  return [
    [SHEETS, outputFiles[0].text],
    [`offline/${SHEETS}`, offline.outputFiles[0].text],
    ...others.outputFiles.map(({ path, text }) => [plain(relative(STATIC, path)), text]),
  ];
}

async function scriptsOf() {
  const found = [
    { entryPoints: SCRIPTS, format: 'iife' },
    { entryPoints: [WIDGET, WORKER] },
    { entryPoints: { 'offline/worker': WORKER }, format: 'iife', define: { 'import.meta.url': '""' } },
  ].map((options) => build({ ...WHOLE, ...options }));
  const all = (await Promise.all(found)).flatMap(({ outputFiles }) => outputFiles);
  return all.map(({ path, text }) => [plain(relative(STATIC, path)), text]);
}

const exported = await exportsOf();
const whole = [...(await pageOf(exported)), ...(await offlineOf(exported))];
const files = [...whole.map(({ name, text }) => [name, text]), ...(await sheetsOf()), ...(await scriptsOf())];
const about = { key: await keyOf(), modules: Object.fromEntries(whole.map(({ name, inputs }) => [name, inputs])) };
await rm(PACKED, { recursive: true, force: true });
for (const [name, text] of [...files, ['packed.json', JSON.stringify(about)]]) {
  await mkdir(dirname(join(PACKED, name)), { recursive: true });
  await writeFile(join(PACKED, name), text);
}
