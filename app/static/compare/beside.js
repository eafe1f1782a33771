// The picture of a kept solution, beside that of the one that is shown, by the same clock.
import { fieldOf as fieldOfRods } from '../axial/field_of.js';
import { unitOf } from '../axial/fields.js';
import { Stage } from '../axial/stage.js';
import { FIELDS } from '../beam/field.js';
import { fieldOf as fieldOfBeam } from '../beam/field_of.js';
import { BeamStage } from '../beam/stage.js';
import { linkField } from '../mechanism/field.js';
import { MechanismStage } from '../mechanism/stage.js';
import { KEPT } from '../charts/styles.js';
import { make } from '../shell/dom.js';
import { text } from '../text/catalogue.js';
import { BodiesStage } from '../space/stage.js';

/** @import { Field, What } from '../axial/fields.js' */
/** @import { BeamField, What as BeamWhat } from '../beam/field.js' */
/** @import { Frame } from '../messages.js' */
/** @import { Run } from './run.js' */

const STAGES = { axial: Stage, beam: BeamStage, mechanism: MechanismStage, bodies: BodiesStage };
const SHOWN = /** @type {const} */ (['stress', 'velocity']);

export class Beside {
  /** @type {Run | null} */ run = null;
  /** @type {Stage | BeamStage | BodiesStage | null} */ stage = null;
  /** @type {Field | null} */ #rods = null;
  /** @type {BeamField | null} */ #beam = null;
  tag = make('span', { className: 'tag' });
  root = make('div', { className: 'beside', hidden: true }, this.tag);

  /** @param {Run | null} run */
  choose(run) {
    if (run === this.run) return;
    this.run = run;
    this.root.hidden = !run;
    this.root.parentElement?.classList.toggle('two', Boolean(run));
    this.stage?.root.remove();
    this.stage = this.#rods = this.#beam = null;
    if (!run) return;
    const { frame, letter } = run;
    this.stage = new STAGES[frame.kind]();
    if (frame.kind === 'axial') this.#rods = fieldOfRods(frame);
    if (frame.kind === 'beam') this.#beam = fieldOfBeam(frame, 'beside');
    if (frame.kind === 'mechanism') this.#beam = linkField(frame, 'beside');
    this.root.append(this.stage.root);
    this.tag.textContent = text('compare.tag', { name: letter });
    this.tag.style.background = KEPT[letter];
  }
  /**
   * Where the colours of the picture end by themselves, in SI units; nothing for other kinds of impacts.
   * @param {What} what
   */
  end(what) {
    const frame = this.run?.frame;
    return frame?.kind === 'axial' && this.#rods ? this.#rods.largest(what) * unitOf(frame, what) : 0;
  }
  /**
   * @param {string} what  colours show, as far as this picture can
   * @param {number} end  of the colours [SI]
   */
  load(what, end) {
    const { run, stage } = this;
    if (!run || !stage) return;
    const { frame } = run;
    if (frame.kind === 'axial' && stage instanceof Stage && this.#rods) {
      const shown = SHOWN.find((name) => name === what) ?? 'stress';
      const own = end || this.end(shown);
      stage.load(frame, this.#rods, shown, own / unitOf(frame, shown));
    } else if ('main' in frame && stage instanceof BeamStage && this.#beam)
      stage.load(frame, this.#beam, FIELDS.find((name) => name === what) ?? 'moment');
    else if (frame.kind === 'bodies' && stage instanceof BodiesStage) stage.load(frame);
  }
  /**
   * Draw the instant at which the other picture is.
   * @param {Frame} now
   * @param {number} t
   */
  draw(now, t) {
    const { run, stage } = this;
    if (!run || !stage) return;
    const { frame } = run;
    if (frame.kind === 'bodies') stage.draw(now.kind === 'bodies' ? (t * now.duration) / frame.duration : 1);
    else stage.draw(now.kind === 'bodies' ? 0 : Math.min((t * now.trip) / frame.trip, frame.duration));
  }
}
