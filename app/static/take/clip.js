// A clip of what is seen: the stretch of time in view plays once and is recorded by the browser.
import { canvasOf, copy } from './picture.js';

/** @import { Page } from '../page.js' */

const KINDS = ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/mp4'];
const PER_SECOND = 30; // frames
const FINE = 2; // pixels for one of the page, at most
const WIDE = 1920; // pixels of a clip, at most
const BITS = 8e6; // a second
const PLAYS = [3, 30]; // seconds
const STANDS = 800; // ms at its end
const LEAST = 1e-9; // of the stretch, that is rounding
const LONGEST = 60_000; // ms, whatever a hand does meanwhile

/** How this browser writes clips; nothing where it cannot. */
export const kindOf = () =>
  KINDS.find((kind) => 'MediaRecorder' in window && MediaRecorder.isTypeSupported(kind)) ?? null;

export class Clip {
  began = 0;
  ended = 0; // when it came to the end of the stretch, which is played once
  end = Infinity;
  /** @type {unknown[]} */ of = []; // what is recorded: another scene, or another duration, ends it

  /**
   * @param {Page} page
   * @param {string} kind  of `kindOf`
   * @param {(clip: Blob, extension: string) => void} done
   */
  constructor(page, kind, done) {
    this.page = page;
    const { root } = page;
    const fine = Math.min(FINE, WIDE / root.clientWidth);
    const { c, canvas } = canvasOf(page, fine);
    this.draw = () => copy(page, c);
    const stream = canvas.captureStream(PER_SECOND);
    this.recorder = new MediaRecorder(stream, { mimeType: kind, videoBitsPerSecond: BITS });
    /** @type {Blob[]} */
    const parts = [];
    this.recorder.ondataavailable = ({ data }) => parts.push(data);
    this.recorder.onstop = () => {
      for (const track of stream.getTracks()) track.stop();
      done(new Blob(parts, { type: kind }), kind.startsWith('video/mp4') ? 'mp4' : 'webm');
    };
  }
  start() {
    const { player } = this.page;
    const [from, to] = player.bar;
    const seconds = Math.min(Math.max((to - from) / (player.usual * player.pace.speed), PLAYS[0]), PLAYS[1]);
    this.end = to - LEAST * (to - from);
    this.began = performance.now();
    this.of = this.#shown;
    this.recorder.start();
    player.through(from, to, seconds * player.pace.speed);
    requestAnimationFrame(() => this.#go());
  }
  get #shown() {
    const { player } = this.page;
    return [player.scene, player.start, player.duration];
  }
  #go() {
    if (this.recorder.state !== 'recording') return;
    if (!this.page.root.isConnected || this.#shown.some((each, k) => each !== this.of[k])) {
      this.stop();
      return;
    }
    this.draw();
    const now = performance.now();
    const { player } = this.page;
    if (player.t >= this.end) this.ended ||= now;
    const ended = this.ended > 0 && now - this.ended > STANDS;
    if (ended || now - this.began > LONGEST) this.stop();
    else requestAnimationFrame(() => this.#go());
  }
  stop() {
    if (this.recorder.state === 'recording') this.recorder.stop();
    if (this.page.player.playing) this.page.player.toggle();
  }
}
