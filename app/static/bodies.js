// The stage for bodies in space: both before (faint) and after one impulse, projected without perspective on the plane
// of the message. Lengths are true; time runs from -1 to 1 in units of the message's `duration`, the blow at 0.
import { cleared, COLORS } from './plot.js';

const INK = { impactor: '#33475b', target: '#2f6fa8' };
const FILL = { impactor: [93, 108, 123], target: [120, 170, 212] };
const EDGES = [[0, 1, 2], [1, 2, 0], [2, 0, 1]];
const CIRCLE = Array.from({ length: 49 }, (_, k) => [Math.cos(k / 24 * Math.PI), Math.sin(k / 24 * Math.PI)]);

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const add = (a, b, f = 1) => [a[0] + f * b[0], a[1] + f * b[1], a[2] + f * b[2]];
const size = (a) => Math.hypot(...a);
const show = (v) => {
  const text = v !== 0 && (Math.abs(v) >= 1e5 || Math.abs(v) < 1e-3) ? v.toExponential(2) : String(Number(v.toPrecision(3)));
  return text.replace('-', '−');
};

export class BodiesStage {
  constructor() {
    this.root = document.createElement('section');
    this.root.className = 'stage bodies';
    this.canvas = document.createElement('canvas');
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label', 'two bodies before and after an impulse, with velocities and spins');
    this.canvas.style.cssText = 'width:100%;height:100%;display:block';
    this.root.append(this.canvas);
  }
  // A decoded message of app/bodies_frame.py.
  load(frame) {
    this.frame = frame;
    this.toward = cross(frame.across, frame.up);
    const box = [Infinity, -Infinity, Infinity, -Infinity];
    let speed = 0, spin = 0;
    for (const name of ['impactor', 'target']) {
      const body = frame.bodies[name];
      for (const when of ['before', 'after']) {
        speed = Math.max(speed, size(body[when].velocity));
        spin = Math.max(spin, size(body[when].spin));
      }
      if (body.shape === 'stop') continue;
      const half = body.radius ?? (body.sides ? size(body.sides) / 2 : 0), path = frame[`${name}Path`];
      for (let k = 0; k < path.length; k += 3) {
        const [x, y] = this.flat([path[k], path[k + 1], path[k + 2]]);
        box[0] = Math.min(box[0], x - half); box[1] = Math.max(box[1], x + half);
        box[2] = Math.min(box[2], y - half); box[3] = Math.max(box[3], y + half);
      }
    }
    Object.assign(this, { box, speed, spin });
  }
  flat(p) {
    return [dot(p, this.frame.across), dot(p, this.frame.up)];
  }
  // Time from -1 to 1.
  draw(t) {
    const { canvas, frame, root } = this;
    if (!frame) return;
    const sheet = cleared(canvas, root);
    if (!sheet) return;
    const { c, width, height } = sheet;
    this.fit(width, height);
    const now = Math.min(Math.max(t, -1), 1), when = now < 0 ? 'before' : 'after';
    for (const name of ['target', 'impactor']) if (frame.bodies[name].shape === 'stop') this.stop(c);
    c.globalAlpha = 0.28;
    for (const name of ['target', 'impactor']) {
      this.trail(c, name);
      this.body(c, name, -1);
      if (now >= 0) this.moves(c, name, -1, 'before', false);
    }
    c.globalAlpha = 1;
    const struck = now >= 0 && frame.impulse > 0;
    if (struck) this.impulse(c, 1 - 0.45 * now);
    for (const name of ['target', 'impactor']) this.body(c, name, now);
    for (const name of ['target', 'impactor']) this.moves(c, name, now, when, true);
    if (struck) this.impulseLabel(c);
    this.legend(c, now, width, height);
  }
  fit(width, height) {
    const [left, right, low, high] = this.box, margin = Math.min(70, 0.14 * Math.min(width, height) + 20);
    const span = Math.max(right - left, high - low, 1e-9);
    this.scale = Math.min((width - 2 * margin) / Math.max(right - left, 0.05 * span), (height - 2 * margin) / Math.max(high - low, 0.05 * span));
    this.x = width / 2 - this.scale * (left + right) / 2;
    this.y = height / 2 + this.scale * (low + high) / 2;
    this.long = 0.2 * Math.min(width, height); // pixels of the longest velocity
  }
  at(p) {
    const [x, y] = this.flat(p);
    return [this.x + this.scale * x, this.y - this.scale * y];
  }
  // Centre and turn (rows) of a body; between samples straight.
  pose(name, t) {
    const path = this.frame[`${name}Path`], turn = this.frame[`${name}Turn`], last = path.length / 3 - 1;
    const place = (t + 1) / 2 * last, k = Math.min(Math.floor(place), last - 1), part = place - k;
    const mix = (values, n, i) => values[n * k + i] + part * (values[n * (k + 1) + i] - values[n * k + i]);
    const rows = [0, 3, 6].map((r) => [mix(turn, 9, r), mix(turn, 9, r + 1), mix(turn, 9, r + 2)]);
    return { centre: [mix(path, 3, 0), mix(path, 3, 1), mix(path, 3, 2)], turned: (v) => rows.map((row) => dot(row, v)) };
  }
  trail(c, name) {
    if (this.frame.bodies[name].shape === 'stop') return;
    const path = this.frame[`${name}Path`];
    c.strokeStyle = INK[name];
    c.lineWidth = 1.2;
    c.setLineDash([3, 5]);
    c.beginPath();
    for (let k = 0; k < path.length; k += 3) c.lineTo(...this.at([path[k], path[k + 1], path[k + 2]]));
    c.stroke();
    c.setLineDash([]);
  }
  body(c, name, t) {
    const body = this.frame.bodies[name];
    if (body.shape === 'stop') return;
    const pose = this.pose(name, t), [x, y] = this.at(pose.centre);
    c.strokeStyle = INK[name];
    c.fillStyle = `rgb(${FILL[name]})`;
    c.lineWidth = 1.3;
    c.lineJoin = c.lineCap = 'round';
    if (body.shape === 'box') this.boxed(c, name, body, pose);
    else if (body.shape === 'ball') this.ball(c, body, pose, x, y);
    else {
      c.beginPath(); c.arc(x, y, 8, 0, 7); c.fill(); c.stroke();
    }
    c.fillStyle = INK[name];
    c.beginPath(); c.arc(x, y, 2.2, 0, 7); c.fill();
  }
  // The faces that look this way; a rod, which has one side only, as a thick line.
  boxed(c, name, body, { centre, turned }) {
    const half = body.axes.map((axis, i) => turned(axis.map((v) => v * body.sides[i] / 2)));
    const thin = body.sides.filter((side) => side === 0).length;
    if (thin === 2) {
      const along = half[body.sides.findIndex((side) => side > 0)];
      for (const [color, wide] of [[INK[name], 10], [`rgb(${FILL[name]})`, 7.5]]) {
        c.strokeStyle = color;
        c.lineWidth = wide;
        c.beginPath(); c.moveTo(...this.at(add(centre, along, -1))); c.lineTo(...this.at(add(centre, along))); c.stroke();
      }
      return;
    }
    for (const [out, one, two] of EDGES) {
      const normal = turned(body.axes[out]), facing = dot(normal, this.toward), way = Math.sign(facing);
      if (Math.abs(facing) < 1e-6) continue;
      const middle = add(centre, half[out], way), light = 0.72 + 0.28 * Math.abs(facing);
      c.fillStyle = `rgb(${FILL[name].map((v) => Math.round(v * light))})`;
      c.beginPath();
      for (const [a, b] of [[1, 1], [1, -1], [-1, -1], [-1, 1]]) c.lineTo(...this.at(add(add(middle, half[one], a), half[two], b)));
      c.closePath(); c.fill(); c.stroke();
    }
  }
  ball(c, body, { centre, turned }, x, y) {
    c.beginPath(); c.arc(x, y, Math.max(body.radius * this.scale, 3), 0, 7); c.fill(); c.stroke();
    c.lineWidth = 0.9;
    for (const [first, second] of [[[1, 0, 0], [0, 1, 0]], [[0, 1, 0], [0, 0, 1]], [[0, 0, 1], [1, 0, 0]]]) {
      const a = turned(first), b = turned(second);
      c.beginPath();
      let drawing = false;
      for (const [cosine, sine] of CIRCLE) { // the half of each painted circle that looks this way
        const out = add(a.map((v) => v * cosine), b, sine), seen = dot(out, this.toward) >= 0;
        const place = this.at(add(centre, out, body.radius));
        if (seen && drawing) c.lineTo(...place); else if (seen) c.moveTo(...place);
        drawing = seen;
      }
      c.stroke();
    }
  }
  // Short, as a body may swing past the place where it was stopped.
  stop(c) {
    const [nx, ny] = this.flat(this.frame.normal), [x, y] = [this.x, this.y], reach = Math.max(0.1 * this.frame.size * this.scale, 16);
    c.strokeStyle = '#55636f';
    c.lineWidth = 4;
    c.beginPath(); c.moveTo(x - ny * reach, y - nx * reach); c.lineTo(x + ny * reach, y + nx * reach); c.stroke();
    c.lineWidth = 1;
    c.beginPath();
    for (let s = -reach; s < reach; s += 10) {
      const px = x + ny * s, py = y + nx * s;
      c.moveTo(px, py); c.lineTo(px + nx * 12 + ny * 8, py - ny * 12 + nx * 8);
    }
    c.stroke();
  }
  // Velocity as an arrow from the centre, spin as an arc about it.
  moves(c, name, t, when, labelled) {
    const body = this.frame.bodies[name];
    if (body.shape === 'stop') return;
    const { velocity, spin } = body[when], from = this.at(this.pose(name, t).centre);
    c.fillStyle = c.strokeStyle = INK[name];
    c.font = '12px system-ui, sans-serif';
    if (size(velocity) > 1e-9 * this.speed) {
      const [vx, vy] = this.flat(velocity).map((v) => v / this.speed * this.long);
      const to = [from[0] + vx, from[1] - vy];
      this.arrow(c, from, to, 2);
      if (labelled) this.label(c, `${show(size(velocity))} m/s`, to, vx, -vy);
    }
    if (size(spin) > 1e-9 * this.spin) this.arc(c, from, spin, labelled);
  }
  arc(c, [x, y], spin, labelled) {
    const seen = dot(spin, this.toward) / this.spin, way = seen < 0 ? -1 : 1, radius = 20;
    const sweep = Math.max(Math.abs(seen) * 1.6 * Math.PI, 0.5), start = 0.35 * Math.PI, end = start + way * sweep;
    c.lineWidth = 1.6;
    c.beginPath();
    c.arc(x, y, radius, -start, -end, way > 0);
    c.stroke();
    const tip = [x + radius * Math.cos(end), y - radius * Math.sin(end)];
    this.head(c, tip, [-way * Math.sin(end), -way * Math.cos(end)], 7);
    if (labelled) this.label(c, `${show(size(spin))} rad/s`, [x, y + radius + 8], 0, 1);
  }
  impulse(c, strength) {
    const [nx, ny] = this.flat(this.frame.normal), long = 0.9 * this.long, { bodies } = this.frame;
    c.globalAlpha = strength;
    c.strokeStyle = c.fillStyle = COLORS.cursor;
    for (const [name, way] of [['target', 1], ['impactor', -1]]) {
      if (bodies[name].shape !== 'stop') this.arrow(c, [this.x, this.y], [this.x + way * nx * long, this.y - way * ny * long], 3.2);
    }
    c.beginPath(); c.arc(this.x, this.y, 4, 0, 7); c.fill();
    c.globalAlpha = 1;
  }
  impulseLabel(c) {
    const side = Math.abs(this.flat(this.frame.normal)[0]) > 0.5 ? [0, -1] : [1, 0];
    c.fillStyle = COLORS.cursor;
    c.font = 'bold 13px system-ui, sans-serif';
    this.label(c, `J = ${show(this.frame.impulse)} N s`, [this.x + 12 * side[0], this.y + 14 * side[1]], ...side);
  }
  arrow(c, from, to, wide) {
    const long = Math.hypot(to[0] - from[0], to[1] - from[1]);
    if (long < 2) return;
    const way = [(to[0] - from[0]) / long, (to[1] - from[1]) / long], tip = Math.min(10, long);
    c.lineWidth = wide;
    c.beginPath(); c.moveTo(...from); c.lineTo(to[0] - way[0] * tip * 0.7, to[1] - way[1] * tip * 0.7); c.stroke();
    this.head(c, to, way, tip);
  }
  head(c, [x, y], [dx, dy], long) {
    c.beginPath();
    c.moveTo(x, y);
    c.lineTo(x - dx * long - dy * long * 0.45, y - dy * long + dx * long * 0.45);
    c.lineTo(x - dx * long + dy * long * 0.45, y - dy * long - dx * long * 0.45);
    c.closePath(); c.fill();
  }
  // Text beyond a point, on the side where (dx, dy) points; a white edge keeps it legible on bodies.
  label(c, text, [x, y], dx, dy) {
    const long = Math.hypot(dx, dy) || 1;
    c.textAlign = Math.abs(dx) < 0.4 * long ? 'center' : dx > 0 ? 'left' : 'right';
    c.textBaseline = Math.abs(dy) < 0.4 * long ? 'middle' : dy > 0 ? 'top' : 'bottom';
    c.save();
    c.lineWidth = 3;
    c.strokeStyle = '#ffffff';
    c.strokeText(text, x + 6 * dx / long, y + 4 * dy / long);
    c.fillText(text, x + 6 * dx / long, y + 4 * dy / long);
    c.restore();
  }
  // Time, a length to measure by, and which way the axes of the world run.
  legend(c, t, width, height) {
    const { frame } = this, wanted = 0.2 * width / this.scale, power = 10 ** Math.floor(Math.log10(wanted));
    const bar = power * [5, 2, 1].find((f) => f * power <= wanted), x = width - 16 - bar * this.scale, y = height - 14;
    c.strokeStyle = c.fillStyle = COLORS.faint;
    c.lineWidth = 1.4;
    c.beginPath(); c.moveTo(x, y - 4); c.lineTo(x, y); c.lineTo(width - 16, y); c.lineTo(width - 16, y - 4); c.stroke();
    c.font = '12px system-ui, sans-serif';
    c.textAlign = 'center';
    c.textBaseline = 'bottom';
    c.fillText(`${show(bar)} m`, (x + width - 16) / 2, y - 5);
    c.textAlign = 'left';
    c.textBaseline = 'top';
    c.fillText(`${show(t * frame.duration * 1e3)} ms ${t < 0 ? 'before' : 'after'} the blow`.replace('−', ''), 12, 10);
    const origin = [34, height - 34];
    ['x', 'y', 'z'].forEach((axis, i) => {
      const [dx, dy] = [frame.across[i] * 24, -frame.up[i] * 24];
      if (Math.hypot(dx, dy) < 5) return;
      this.arrow(c, origin, [origin[0] + dx, origin[1] + dy], 1.2);
      this.label(c, axis, [origin[0] + dx, origin[1] + dy], dx, dy);
    });
  }
}
