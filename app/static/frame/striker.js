// The striker in the picture can be taken hold of: pulled back it strikes faster, dragged larger it weighs more.
import { letters } from '../charts/canvas.js';
import { COLORS } from '../charts/styles.js';
import { text } from '../text/catalogue.js';
import { figures } from '../text/format.js';

/** @import { Page } from '../page.js' */

const DOUBLE = 70; // pixels of pulling that double the speed
const POWER = 6; // of the drawn size, which the mass follows: see the stages
const CORNER = 11; // pixels about the corner that sets the size
const SLACK = 6; // and about the body
const ARROW = 42; // length of the arrow [px]

/**
 * The striker as it is drawn.
 * @typedef {object} Drawn
 * @property {number} x  middle [px]
 * @property {number} y
 * @property {number} width
 * @property {number} height
 * @property {[number, number]} way  it goes
 * @property {boolean} sized  its size shows its mass
 */

export class Striker {
  /** @type {'speed' | 'mass' | null} */ over = null; // what the pointer would take hold of
  held = false;
  /** @type {Drawn | null} */ drawn = null;

  /**
   * @param {Page} page
   * @param {HTMLCanvasElement} canvas
   * @param {() => void} redraw
   */
  constructor(page, canvas, redraw) {
    this.page = page;
    this.canvas = canvas;
    this.redraw = redraw;
    canvas.style.touchAction = 'none';
    canvas.addEventListener('pointermove', (event) => {
      if (!this.held) this.#look(event);
    });
    canvas.addEventListener('pointerleave', () => this.held || this.#turn(null));
    canvas.addEventListener('pointerdown', (event) => this.#take(event));
  }
  /**
   * @param {string} name
   * @returns {boolean}
   */
  #acts(name) {
    return this.page.frame.acting.includes(name);
  }
  /**
   * Where the corner is that sets the size.
   * @param {Drawn} drawn
   * @returns {[number, number]}
   */
  #corner({ x, y, width, height, way }) {
    return [x - (way[0] < 0 ? -1 : 1) * 0.5 * width, y - 0.5 * height];
  }
  /**
   * What the pointer is over.
   * @param {PointerEvent} event
   */
  #look(event) {
    const { drawn } = this;
    if (!drawn) return;
    const [x, y] = [event.offsetX, event.offsetY];
    const [a, b] = this.#corner(drawn);
    const near = Math.hypot(x - a, y - b) < CORNER;
    const on = Math.abs(x - drawn.x) < 0.5 * drawn.width + SLACK && Math.abs(y - drawn.y) < 0.5 * drawn.height + SLACK;
    if (near && drawn.sized && this.#acts('mass_ratio')) this.#turn('mass');
    else this.#turn(on && this.#acts('speed') ? 'speed' : null);
  }
  /** @param {'speed' | 'mass' | null} over */
  #turn(over) {
    if (over === this.over) return;
    this.over = over;
    this.canvas.style.cursor = over === 'mass' ? 'nwse-resize' : over ? 'grab' : '';
    this.redraw();
  }
  /** @param {PointerEvent} event */
  #take(event) {
    this.#look(event);
    const { canvas, drawn, over, page } = this;
    if (!over || !drawn || event.button !== 0) return;
    event.preventDefault();
    canvas.setPointerCapture(event.pointerId);
    this.held = true;
    canvas.style.cursor = over === 'mass' ? 'nwse-resize' : 'grabbing';
    const from = [event.clientX, event.clientY];
    const name = over === 'mass' ? 'mass_ratio' : 'speed';
    const before = this.#value(name);
    const size = Math.max(drawn.width, drawn.height);
    const { low, high } = page.model.spec[name];
    const [across, down] = drawn.way;
    canvas.onpointermove = (moved) => {
      const [dx, dy] = [moved.clientX - from[0], moved.clientY - from[1]];
      const back = -(dx * across + dy * down);
      const larger = -(dx * (across < 0 ? -1 : 1) + dy); // as far as the corner has gone outwards
      const heavier = before * (size / Math.max(size + larger, 4)) ** POWER;
      const value = over === 'mass' ? heavier : before * 2 ** (back / DOUBLE);
      page.choose(name, Number(Math.min(Math.max(value, low), high).toPrecision(3)));
    };
    canvas.onpointerup = canvas.onpointercancel = () => {
      canvas.onpointermove = canvas.onpointerup = canvas.onpointercancel = null;
      this.held = false;
      this.#turn(null);
    };
  }
  /**
   * Of a choice, whether the server knows of it or not.
   * @param {string} name
   */
  #value(name) {
    const { model, waiting } = this.page;
    return Number(waiting[name] ?? model[name]);
  }
  /**
   * What can be taken hold of, over the picture.
   * @param {CanvasRenderingContext2D} c
   * @param {Drawn | null} drawn
   */
  draw(c, drawn) {
    this.drawn = drawn;
    if (!drawn) return;
    if (drawn.sized && this.#acts('mass_ratio')) this.#handle(c, drawn);
    if (this.over === 'speed' && this.#acts('speed')) this.#arrow(c, drawn);
  }
  /**
   * @param {CanvasRenderingContext2D} c
   * @param {Drawn} drawn
   */
  #handle(c, drawn) {
    const [x, y] = this.#corner(drawn);
    c.beginPath();
    c.arc(x, y, this.over === 'mass' ? 6 : 4, 0, 7);
    c.fillStyle = '#fff';
    c.strokeStyle = COLORS.waves;
    c.lineWidth = 2;
    c.fill();
    c.stroke();
    if (this.over !== 'mass') return;
    const ratio = figures(this.#value('mass_ratio'));
    this.#say(
      c,
      `m₂/m₁ = ${ratio}${this.held ? '' : ` · ${text('player.drag')}`}`,
      Math.max(x - 6, 8),
      Math.max(y - 10, 12),
    );
  }
  /**
   * @param {CanvasRenderingContext2D} c
   * @param {Drawn} drawn
   */
  #arrow(c, { x, y, width, height, way: [across, down] }) {
    const lying = Math.abs(across) > 0.5;
    const [fromX, fromY] = [x, lying ? y - 0.5 * height - 9 : y];
    const [toX, toY] = [fromX + across * ARROW, fromY + down * ARROW];
    c.strokeStyle = c.fillStyle = COLORS.waves;
    c.lineWidth = 2;
    c.beginPath();
    c.moveTo(fromX, fromY);
    c.lineTo(toX, toY);
    c.stroke();
    c.beginPath();
    c.moveTo(toX + 8 * across, toY + 8 * down);
    c.lineTo(toX - 5 * down, toY + 5 * across);
    c.lineTo(toX + 5 * down, toY - 5 * across);
    c.fill();
    const speed = `${figures(this.#value('speed'))} m/s${this.held ? '' : ` · ${text('player.pull')}`}`;
    if (lying) this.#say(c, speed, Math.max(x - 0.5 * width, 8), Math.max(fromY - 8, 12));
    else this.#say(c, speed, x - 0.5 * width - 8, y, 'right');
  }
  /**
   * @param {CanvasRenderingContext2D} c
   * @param {string} words
   * @param {number} x
   * @param {number} y
   * @param {CanvasTextAlign} align
   */
  #say(c, words, x, y, align = 'left') {
    c.font = letters(13, 'bold ');
    c.textAlign = align;
    c.textBaseline = 'alphabetic';
    c.lineWidth = 3;
    c.strokeStyle = '#fff';
    c.strokeText(words, x, y);
    c.fillStyle = COLORS.waves;
    c.fillText(words, x, y);
  }
}
