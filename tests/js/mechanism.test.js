// Mechanisms on the stage: fields of links from amounts of shapes, which side is pressed, links that move on.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Bending } from '../../app/static/mechanism/bending.js';
import { drawGhosts, ghostsOf } from '../../app/static/mechanism/ghosts.js';
import { Mechanism } from '../../app/static/mechanism/mechanism.js';
import { MovingMechanism } from '../../app/static/mechanism/moving.js';
import { css } from '../../app/static/charts/styles.js';

const LINK = { name: 'bar', flexible: true, nodes: [], depth: 0.01 };
const TOLD = { links: [LINK], joints: [], struck: 0, at: 1, contact: [1, 0], normal: [0, -1], mass: 1 };
const SHAPES = {
  bendTime: [0, 1, 2],
  amountsOf0: [0, 1, 0],
  shapeOf0: [0, 0.5, 1],
  shapeScaleOf0: [0.02],
  momentOf0: [1, 0.5, 0],
  momentScaleOf0: [30],
  shearOf0: [1, 1, 1],
  shearScaleOf0: [7],
};
const numbers = (table) => Object.fromEntries(Object.entries(table).map(([key, row]) => [key, Float64Array.from(row)]));
const frameOf = (more = {}, shapes = {}) => ({
  mechanism: TOLD,
  impactor: { kind: 'mass', mass: 1 },
  main: { joints: [] },
  contacts: [[1, 1, 1, 0]],
  duration: 2,
  ...numbers({ linkTime: [0, 2], ...more }),
  shapes: { linkPoints: [1, 2, 2], ...shapes },
});
const still = { linkPoints: [0, 0, 1, 0], linkMoves: [0, 0, 0, 0, 0, 0, 0, 0] };
/** A canvas that notes its strokes: colour, and where they begin and end. */
function canvas() {
  const strokes = [];
  let points = [];
  const c = {
    beginPath: () => (points = []),
    moveTo: (x, y) => points.push([x, y]),
    lineTo: (x, y) => points.push([x, y]),
    stroke: () => strokes.push({ color: c.strokeStyle, points }),
  };
  return { c, strokes };
}

test('fields of a link are amounts of its shapes, straight between the instants', () => {
  const bending = new Bending(frameOf(SHAPES, { shapeOf0: [1, 3] }), 0);
  assert.deepEqual([...bending.profile(0.5, 'deflection')], [0, 0.005, 0.01]);
  assert.deepEqual([...bending.profile(1, 'moment')], [30, 15, 0]);
  assert.deepEqual([...bending.profile(1.5, 'shear')], [3.5, 3.5, 3.5]);
  assert.deepEqual([...bending.profile(0.5, 'velocity')], [0, 0.01, 0.02]); // m/s
  assert.ok(Math.abs(bending.largest - 0.02) < 2e-4);
});

test('a positive moment presses the left side of a link, wherever it is struck from', () => {
  for (const normal of [
    [0, -1],
    [0, 1],
  ]) {
    const frame = { ...frameOf(still), mechanism: { ...TOLD, normal } };
    const mechanism = new Mechanism(frame, 0.01);
    mechanism.fit(400, 200);
    mechanism.place(0);
    const { c, strokes } = canvas();
    mechanism.links(c, () => 1, 1, true);
    const height = (sign) => strokes.find(({ color }) => color === css(sign, 1)).points[0][1];
    assert.ok(height(1) < height(-1)); // downwards: of a bar to the right, its left is above
  }
});

test('links that move on are to scale, bent larger, and the mass meets them where they are drawn', () => {
  const turned = [0, 0, 0, 0, 0, 0, -1, 1]; // the bar stands upright at the end
  const flown = { massPlaces: [1, 0, 1, 0], normals: [1, 1, -1, -1] };
  const frame = frameOf({ linkPoints: [0, 0, 1, 0], linkMoves: turned, ...flown, ...SHAPES }, { shapeOf0: [1, 3] });
  const mechanism = new MovingMechanism(frame);
  mechanism.fit(400, 200);
  assert.equal(mechanism.factor, 2); // 6 % of its size over 2 cm, and not more than a round number
  mechanism.place(0);
  const [[x0, y0], , [x1]] = mechanism.placed[0];
  assert.ok(Math.abs(x1 - x0 - mechanism.scale) < 1e-9);
  mechanism.place(2);
  const [, , [x2, y2]] = mechanism.placed[0];
  assert.ok(Math.abs(x2 - x0) < 1e-6 && Math.abs(y0 - y2 - mechanism.scale) < 1e-6);
  const { time, x, y } = mechanism.beside;
  assert.deepEqual(time, [1, 1]);
  assert.ok(Math.abs(Math.hypot(x[0], y[0]) - 0.02) < 1e-12); // once more the deflection of the tip
});

/** A canvas that notes its words and their middles; a letter is 6 pixels wide. */
function sheet() {
  const words = [];
  const c = {
    ...{ stroke() {}, fill() {}, beginPath() {}, moveTo() {}, lineTo() {}, setLineDash() {}, strokeText() {} },
    measureText: (text) => ({ width: 6 * text.length }),
    fillText: (text, x, y) => words.push({ text, x, y }),
  };
  return { c, words };
}

test('names of links lie on no link, within the picture, and stay where they need not move', () => {
  const points = [0, 0, 0.5, 1, 0.5, 1, 1, 0, 1, 0, 1.5, 1]; // three bars, up and down
  const links = ['crank', 'coupler', 'bar'].map((name) => ({ ...LINK, name, flexible: false }));
  const told = { ...TOLD, links, struck: 2, contact: [1.5, 1] };
  const linkMoves = Array.from({ length: 24 }, () => 0);
  const frame = { ...frameOf({ linkPoints: points, linkMoves }), mechanism: told };
  const mechanism = new Mechanism(frame, 0.01);
  mechanism.fit(300, 120);
  mechanism.place(0);
  const { c, words } = sheet();
  mechanism.labels.draw(c, []);
  assert.deepEqual(
    words.map(({ text }) => text),
    ['crank', 'coupler', 'bar'],
  );
  for (const { text, x, y } of words) {
    const half = 3 * text.length;
    assert.ok(x - half > 0 && x + half < 300 && y > 6 && y < 114);
    for (const [[ax, ay], [bx, by]] of mechanism.placed)
      for (let share = 0; share <= 1; share += 0.01) {
        const [px, py] = [ax + share * (bx - ax), ay + share * (by - ay)];
        assert.ok(Math.abs(px - x) > half || Math.abs(py - y) > 6, `${text} lies on a link`);
      }
  }
  const before = words.splice(0);
  mechanism.labels.draw(c, []);
  assert.deepEqual(words, before);
});

test('of a mass that has left the picture it is said how far it is', () => {
  const flown = { massPlaces: [1, 0, 61, 0], normals: [1, 1, -1, -1] };
  const moves = { linkPoints: [0, 0, 1, 0], linkMoves: [0, 0, 0, 0, 0, 0, 0, 0] };
  const mechanism = new MovingMechanism(
    frameOf({ ...moves, ...flown, linkTime: [0, 2], ...SHAPES }, { shapeOf0: [1, 3] }),
  );
  mechanism.fit(400, 200);
  mechanism.place(2);
  const { c, words } = sheet();
  mechanism.striker(c, 2);
  const [{ text, x }] = words;
  const beyond = 60.5 - 200 / mechanism.scale; // from the middle of the bar to the edge of the picture
  assert.equal(text, `mass: ${beyond.toPrecision(2)}\u00a0m beyond`);
  assert.ok(x < 400);
  assert.equal(mechanism.held, null); // nothing to take hold of
});

test('a link that goes far has its way drawn in steps as large as one another, the paler the further in time', () => {
  const points = Float64Array.of(0, 0, 1, 0);
  const times = Float64Array.from({ length: 101 }, (_, k) => k / 100);
  const moved = (far) => Float64Array.from([...times].flatMap((t) => [0, 0, 0, far * t * t])); // ever faster
  const ghosts = ghostsOf(times, points, moved(1), 1);
  assert.ok(ghosts.length >= 10 && ghosts.length <= 11);
  for (const [k, { ends }] of ghosts.entries()) if (k) assert.ok(ends[3] - ghosts[k - 1].ends[3] < 0.12);
  assert.deepEqual(ghostsOf(times, points, moved(0.1), 1), []); // it hardly moves
  const strokes = [];
  let line = [];
  const c = {
    ...{ save() {}, restore() {}, beginPath: () => (line = []), moveTo: (...at) => line.push(at) },
    ...{ lineTo: (...at) => line.push(at), stroke: () => strokes.push({ line, alpha: c.globalAlpha }) },
  };
  drawGhosts(c, ghosts, 0.7, (x, y) => [100 * x, -100 * y]);
  assert.equal(strokes.length, ghosts.length);
  const alpha = strokes.map((stroke) => stroke.alpha);
  const next = ghosts.findIndex(({ t }) => t > 0.7);
  assert.equal(alpha[next], Math.max(...alpha));
  assert.ok(alpha[0] < alpha[next - 1]);
  assert.deepEqual(strokes[next].line, [
    [0, -0],
    [100, -100 * ghosts[next].ends[3]],
  ]);
});
