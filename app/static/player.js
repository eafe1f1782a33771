// The clock: play, pause, scrub, speed. It runs in the browser alone; nothing is sent while it plays.

const SECONDS_PER_TRIP = 3, SECONDS_PER_BEAM = 24; // at normal speed
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];

const make = (tag, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
};

// Where a blow on a beam is shown at first: as on rods, in the first contact, once waves have set out.
const opening = ({ contacts: [[start, end]] }) => start + 0.9 * (end - start);

export class Player {
  // `show(t)` draws the instant t [round trips].
  constructor(show) {
    this.show = show;
    this.t = 0;
    this.playing = this.played = false; // now, and ever
    this.speed = 1;
    this.button = make('button', { type: 'button', className: 'play' });
    this.scrub = make('input', { type: 'range', min: 0, max: 10000, step: 1, className: 'scrub' });
    this.scrub.setAttribute('aria-label', 'Time');
    this.pace = make('select', { className: 'pace' });
    this.pace.setAttribute('aria-label', 'Playback speed');
    for (const s of SPEEDS) this.pace.append(make('option', { value: s, textContent: `${s}×`, selected: s === 1 }));
    this.clock = make('output', { className: 'clock' });
    this.slow = make('span', { className: 'slow' });
    this.root = make('div', { className: 'player' }, this.button, this.scrub, this.clock, this.pace, this.slow);
    this.button.onclick = () => this.toggle();
    this.scrub.oninput = () => this.go(Number(this.scrub.value) / 10000 * this.duration);
    this.pace.onchange = () => { this.speed = Number(this.pace.value); this.label(); };
    this.loop = this.loop.bind(this);
    this.label();
  }
  load(frame) {
    const first = !this.duration;
    // bodies in space: time runs from -1 to 1 in units of the message's duration, the blow at 0
    this.start = frame.kind === 'bodies' ? -1 : 0;
    this.duration = frame.kind === 'bodies' ? 2 : frame.duration;
    this.trip = frame.kind === 'bodies' ? frame.duration : frame.trip;
    // long blows play in about half a minute; on a beam, where no wave comes back as it went, all of them in less
    this.inTrips = frame.kind === 'axial';
    this.perSecond = frame.kind === 'beam' ? this.duration / SECONDS_PER_BEAM : Math.max(1 / SECONDS_PER_TRIP, this.duration / 30);
    this.usual = this.perSecond;
    this.until = Infinity;
    if (first) this.t = Math.min(0.36, 0.4 * this.duration);
    if (frame.kind === 'bodies' && this.was !== 'bodies') this.t = 1.7; // after the blow
    if (frame.kind === 'beam' && this.was !== 'beam') this.t = opening(frame);
    this.was = frame.kind;
    this.t = Math.min(this.t, this.duration);
    this.label();
    this.go(this.t);
  }
  label() {
    this.button.textContent = this.playing ? '❚❚ Pause' : '▶ Play';
    this.button.setAttribute('aria-pressed', String(this.playing));
    if (this.trip) {
      const slower = 1 / (this.perSecond * this.speed * this.trip);
      this.slow.textContent = slower > 1 ? `slowed ${Number(slower.toPrecision(2)).toLocaleString('en')} times` : '';
    }
  }
  // Play a stretch of time, to last so many seconds.
  through(start, end, seconds) {
    const idle = !this.playing;
    this.playing = this.played = true;
    this.perSecond = (end - start) / seconds;
    this.until = end;
    this.last = 0;
    this.label();
    this.go(start);
    if (idle) requestAnimationFrame(this.loop);
  }
  toggle() {
    this.playing = !this.playing;
    this.played = true;
    this.perSecond = this.usual;
    this.until = Infinity;
    if (this.playing && this.t >= this.duration - 1e-9) this.t = 0;
    this.last = 0;
    this.label();
    if (this.playing) requestAnimationFrame(this.loop);
  }
  loop(now) {
    if (!this.playing || !this.root.isConnected) return;
    const elapsed = this.last ? Math.min(now - this.last, 100) / 1000 : 0;
    this.last = now;
    this.go(this.t + elapsed * this.perSecond * this.speed);
    if (this.t >= Math.min(this.duration, this.until)) { this.playing = false; this.label(); return; }
    requestAnimationFrame(this.loop);
  }
  go(t) {
    this.t = Math.min(Math.max(t, 0), this.duration);
    this.scrub.value = Math.round(this.t / this.duration * 10000);
    const now = this.t + this.start, real = now * this.trip, size = Math.abs(real);
    const [factor, unit] = size < 1e-3 ? [1e6, 'µs'] : size < 1 ? [1e3, 'ms'] : [1, 's'];
    const trips = !this.inTrips ? '' : `${this.t.toFixed(3)} T = `;
    this.clock.textContent = `${trips}${(real * factor).toFixed(1).replace('-', '−')} ${unit}`;
    this.scrub.setAttribute('aria-valuetext', this.clock.textContent);
    this.show(now);
  }
}
